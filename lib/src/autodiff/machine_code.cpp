#include "src/autodiff/machine_code.hpp"

#include "src/autodiff/code_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>

#if defined(__linux__) && defined(__x86_64__)
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>
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

/// Memory for code, mapped twice: executable in one place, writable in another. Changing the protection of
/// one place took as long as some hundred sweeps on a virtual machine. Pieces that are given back are kept
/// for later use, up to a bound. A process and its fork share what was mapped before: neither writes there
/// again.
class Pages {
 public:
  /// Returns a piece of at least so many bytes; empty where there is none.
  CodeMemory take(std::size_t size) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = kept_.size(); i-- > 0;)
      if (kept_[i].size >= size && kept_[i].size <= 4 * size + least) {
        const CodeMemory piece = kept_[i];
        kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
        return piece;
      }
    return map((size + least - 1) / least * least);
  }
  void give_back(const CodeMemory& piece) {
    const std::lock_guard lock(mutex_);
    if (piece.forks == forks_ && kept_.size() < most && piece.size <= largest)
      kept_.push_back(piece);
    else
      unmap(piece);
  }
  /// The only instance, which outlives everything that may still give pieces back.
  static Pages& all() {
    static Pages* const pages = new Pages;
    return *pages;
  }

 private:
  Pages() {
    kept_.reserve(most);
    const auto before = [] { all().lock_for_fork(); };
    const auto after = [] { all().mutex_.unlock(); };
    counts_forks_ = pthread_atfork(before, after, after) == 0;
  }
  void lock_for_fork() {
    mutex_.lock();
    ++forks_;
    std::ranges::for_each(kept_, unmap);
    kept_.clear();
  }
  [[nodiscard]] CodeMemory map(std::size_t size) const {
    const int file = counts_forks_ ? memfd_create("avi", MFD_CLOEXEC) : -1;
    if (file < 0) return {};
    CodeMemory piece{.size = size, .forks = forks_};
    if (ftruncate(file, static_cast<off_t>(size)) == 0) {
      piece.run = mmap(nullptr, size, PROT_READ | PROT_EXEC, MAP_SHARED, file, 0);
      piece.write = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    }
    close(file);
    if (piece.run != MAP_FAILED && piece.write != MAP_FAILED) return piece;
    unmap(piece);
    return {};
  }
  static void unmap(const CodeMemory& piece) {
    for (void* const view : {piece.run, piece.write})
      if (view && view != MAP_FAILED) munmap(view, piece.size);
  }
  static constexpr std::size_t least = 4096, largest = 1 << 16, most = 32;
  std::mutex mutex_;
  std::vector<CodeMemory> kept_;
  unsigned forks_ = 0;         // of this process and those that it comes from, since the library was loaded
  bool counts_forks_ = false;  // otherwise no memory is mapped
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
  const CodeMemory memory = made->memory_ = Pages::all().take(size);
  if (!memory.run) return nullptr;
  const auto address = reinterpret_cast<std::uint64_t>(memory.run);
  for (const std::size_t at : addresses)
    std::memcpy(&assembler.code[at], &address, sizeof(address));
  auto* const to = static_cast<double*>(memory.write);
  for (std::size_t i = 0; i < pool.size(); ++i)
    std::fill_n(to + i * lanes, lanes, pool[i]);
  std::memcpy(static_cast<char*>(memory.write) + numbers, assembler.code.data(), assembler.code.size());
  for (const std::size_t begin : begins)
    made->functions_.push_back(reinterpret_cast<Function>(address + numbers + begin));
  return made;
#else
  return (void)programs, (void)target, nullptr;
#endif
}

MachineCode::~MachineCode() {
#ifdef AVI_CAN_MAKE_CODE
  if (memory_.run) Pages::all().give_back(memory_);
#endif
}

}  // namespace avi::detail
