#include "machine_code.hpp"

#include "code_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>

#if defined(__linux__) && defined(__x86_64__)
#include <sys/mman.h>
#define AVI_CAN_MAKE_CODE
#endif

namespace avi::detail {

namespace {

/// Returns the setting of AVI_MACHINE_CODE.
bool wanted() {
  const char* const said = std::getenv("AVI_MACHINE_CODE");
  const std::string word = said ? said : "";
  if (word.empty() || word == "on") return true;
  if (word == "off") return false;
  throw std::invalid_argument("AVI_MACHINE_CODE is " + word + "; it must be on or off.");
}

#ifdef AVI_CAN_MAKE_CODE
/// Largest number of bytes of the stack that a program may take: the gradient of a long formula needs all
/// results before it.
constexpr std::size_t most_frame = 1 << 20;

/// Memory for code. Pieces that are given back are kept for later use, up to a bound: the system takes three
/// times as long to map new pages as to change the protection of old ones.
class Pages {
 public:
  struct Piece {
    void* at = nullptr;
    std::size_t size = 0;
  };
  /// Returns a writable piece of at least so many bytes; null where there is none.
  Piece take(std::size_t size) {
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t i = kept_.size(); i-- > 0;)
        if (kept_[i].size >= size && kept_[i].size <= 4 * size + least) {
          const Piece piece = kept_[i];
          kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
          if (mprotect(piece.at, piece.size, PROT_READ | PROT_WRITE) == 0) return piece;
          unmap(piece);
        }
    }
    // Inaccessible pages keep pieces apart: otherwise, a change of protection would make the system join or
    // split the mappings of neighbouring pieces.
    size = (size + least - 1) / least * least;
    void* const whole = mmap(nullptr, size + 2 * least, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (whole == MAP_FAILED) return {};
    const Piece piece{static_cast<char*>(whole) + least, size};
    if (mprotect(piece.at, size, PROT_READ | PROT_WRITE) == 0) return piece;
    unmap(piece);
    return {};
  }
  void give_back(const Piece& piece) {
    {
      const std::lock_guard lock(mutex_);
      if (kept_.size() < most && piece.size <= largest) {
        kept_.push_back(piece);
        return;
      }
    }
    unmap(piece);
  }
  /// The only instance, which outlives everything that may still give pieces back.
  static Pages& all() {
    static Pages* const pages = new Pages;
    return *pages;
  }

 private:
  static void unmap(const Piece& piece) {
    munmap(static_cast<char*>(piece.at) - least, piece.size + 2 * least);
  }
  static constexpr std::size_t least = 4096, largest = 1 << 16, most = 32;
  std::mutex mutex_;
  std::vector<Piece> kept_ = [] {
    std::vector<Piece> none;
    none.reserve(most);
    return none;
  }();
};
#endif

}  // namespace

std::unique_ptr<const MachineCode> MachineCode::of(std::span<const Program* const> programs,
                                                   const MachineTarget& target) {
  if (!wanted()) return nullptr;
#ifdef AVI_CAN_MAKE_CODE
  Assembler assembler(std::min(target.lanes, target.avx512 ? 8 : 4));
  std::vector<double> pool{1.0, 0.0, -0.0, std::bit_cast<double>(~std::uint64_t{0} >> 1)};
  std::vector<std::size_t> begins, addresses;
  for (const Program* program : programs) {
    assembler.code.resize((assembler.code.size() + 15) / 16 * 16, 0xcc);
    begins.push_back(assembler.code.size());
    const StraightLine line(*program);
    CodeWriter writer(line, target, pool, assembler);
    addresses.push_back(writer.write());
    if (writer.frame() > most_frame) return nullptr;
  }
  const auto lanes = static_cast<std::size_t>(assembler.bytes() / 8);
  const std::size_t numbers = (8 * lanes * pool.size() + 63) / 64 * 64,
                    size = numbers + assembler.code.size();
  std::unique_ptr<MachineCode> made(new MachineCode);
  const auto [memory, whole] = Pages::all().take(size);
  if (!memory) return nullptr;
  made->memory_ = memory;
  made->size_ = whole;
  const auto address = reinterpret_cast<std::uint64_t>(memory);
  for (const std::size_t at : addresses)
    std::memcpy(&assembler.code[at], &address, sizeof(address));
  auto* const to = static_cast<double*>(memory);
  for (std::size_t i = 0; i < pool.size(); ++i)
    std::fill_n(to + i * lanes, lanes, pool[i]);
  std::memcpy(static_cast<char*>(memory) + numbers, assembler.code.data(), assembler.code.size());
  if (mprotect(memory, whole, PROT_READ | PROT_EXEC) != 0) return nullptr;
  for (const std::size_t begin : begins)
    made->functions_.push_back(reinterpret_cast<Function>(address + numbers + begin));
  return made;
#else
  return (void)programs, (void)target, nullptr;
#endif
}

MachineCode::~MachineCode() {
#ifdef AVI_CAN_MAKE_CODE
  if (memory_) Pages::all().give_back({memory_, size_});
#endif
}

}  // namespace avi::detail
