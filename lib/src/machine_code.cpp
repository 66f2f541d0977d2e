#include "machine_code.hpp"

#include "code_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#if defined(__linux__) && defined(__x86_64__)
#include <sys/mman.h>
#define AVI_CAN_MAKE_CODE
#endif

namespace avi::detail {

namespace {

/// The setting of AVI_MACHINE_CODE.
bool wanted() {
  const char* const said = std::getenv("AVI_MACHINE_CODE");
  const std::string word = said ? said : "";
  if (word.empty() || word == "on") return true;
  if (word == "off") return false;
  throw std::invalid_argument("AVI_MACHINE_CODE is " + word + "; it must be on or off.");
}

}  // namespace

std::unique_ptr<const MachineCode> MachineCode::of(std::span<const Program* const> programs,
                                                   const MachineTarget& target) {
  if (!wanted()) return nullptr;
#ifdef AVI_CAN_MAKE_CODE
  Assembler assembler(target.avx512 ? target.lanes : 4);
  std::vector<double> pool{1.0, 0.0, -0.0, std::bit_cast<double>(~std::uint64_t{0} >> 1)};
  std::vector<std::size_t> begins, addresses;
  for (const Program* program : programs) {
    assembler.code.resize((assembler.code.size() + 15) / 16 * 16, 0xcc);
    begins.push_back(assembler.code.size());
    addresses.push_back(CodeWriter(StraightLine(*program), target, pool, assembler).write());
  }
  const auto lanes = static_cast<std::size_t>(assembler.bytes() / 8);
  const std::size_t numbers = (8 * lanes * pool.size() + 63) / 64 * 64,
                    size = numbers + assembler.code.size();
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  std::unique_ptr<MachineCode> made(new MachineCode);
  made->memory_ = memory;
  made->size_ = size;
  const auto address = reinterpret_cast<std::uint64_t>(memory);
  for (const std::size_t at : addresses)
    std::memcpy(&assembler.code[at], &address, sizeof(address));
  auto* const to = static_cast<double*>(memory);
  for (std::size_t i = 0; i < pool.size(); ++i)
    std::fill_n(to + i * lanes, lanes, pool[i]);
  std::memcpy(static_cast<char*>(memory) + numbers, assembler.code.data(), assembler.code.size());
  if (mprotect(memory, size, PROT_READ | PROT_EXEC) != 0) return nullptr;
  for (const std::size_t begin : begins)
    made->functions_.push_back(reinterpret_cast<Function>(address + numbers + begin));
  return made;
#else
  return (void)programs, (void)target, nullptr;
#endif
}

MachineCode::~MachineCode() {
#ifdef AVI_CAN_MAKE_CODE
  if (memory_) munmap(memory_, size_);
#endif
}

}  // namespace avi::detail
