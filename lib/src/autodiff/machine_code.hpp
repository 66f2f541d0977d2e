#pragma once
#include "avi/autodiff/program.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

/// @file
/// Programs as machine code, made at run time.

namespace avi::detail {

/// A function that sets a = operation(a, b) for two packs, or for a alone if the operation has one operand.
using PackFunction = void (*)(double* a, const double* b);

/// The target of machine code.
struct MachineTarget {
  int lanes;                      ///< Count of numbers in a pack.
  bool avx512;                    ///< Whether there is AVX-512, else AVX2.
  const PackFunction* functions;  ///< Function of each Operation of more than a few instructions.
  int parameters = 0;             ///< Number of the last arguments, which lie behind the factor.
};

/// Memory for code, seen from two places.
struct CodeMemory {
  void* run = nullptr;    ///< Where it can be executed and read; null if there is none.
  void* write = nullptr;  ///< Where it can be written.
  std::size_t size = 0;   ///< Number of bytes.
  unsigned forks = 0;     ///< Number of forks before it was mapped.
};

/// The machine code of programs: straight lines of instructions without branches, which keep intermediate
/// results in registers. It computes what Program::run() does, with the same bits.
class MachineCode {
 public:
  /// A function that evaluates one program at packs: out[i] = factor times its derivative i, or out[0] = its
  /// value where it has no derivatives. @param q,p first and second half of its arguments @param factor the
  /// factor, then the parameters
  using Function = void (*)(const double* q, const double* p, const double* factor, double* out);

  /// Makes the code of some programs. The result is null where the system does not let code be made, the
  /// processor is another one, the code would take more than a mebibyte of the stack, or the environment
  /// variable AVI_MACHINE_CODE is "off". @throws std::invalid_argument where that variable is neither "on"
  /// nor "off" nor empty.
  static std::unique_ptr<const MachineCode> of(std::span<const Program* const> programs,
                                               const MachineTarget& target);
  ~MachineCode();
  MachineCode(const MachineCode&) = delete;             ///< Deleted: the code owns its memory.
  MachineCode& operator=(const MachineCode&) = delete;  ///< Deleted: the code owns its memory.

  [[nodiscard]] Function operator[](std::size_t program) const { return functions_[program]; }  ///< Its code.

 private:
  MachineCode() = default;
  CodeMemory memory_;
  std::vector<Function> functions_;
};

}  // namespace avi::detail
