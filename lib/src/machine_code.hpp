#pragma once
#include "avi/autodiff/program.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

/// @file
/// Programs as machine code, made at run time.

namespace avi::detail {

/// a = operation(a, b) of two packs; of one alone where the operation has one operand.
using PackFunction = void (*)(double* a, const double* b);

/// The target of machine code.
struct MachineTarget {
  int lanes;                      ///< Numbers in a pack.
  bool avx512;                    ///< Else AVX2.
  const PackFunction* functions;  ///< For each Operation, called where it is not a few instructions.
  int parameters = 0;             ///< The last arguments, which lie behind the factor.
};

/// Programs as straight lines of the processor's instructions: intermediate results live in registers and
/// nothing is decided on the way. They compute what Program::run() does with the same bits.
class MachineCode {
 public:
  /// One program at packs: out[i] = factor times its derivative i, or out[0] = its value where it has no
  /// derivatives. @param q,p the first and second half of its arguments @param factor and the parameters
  using Function = void (*)(const double* q, const double* p, const double* factor, double* out);

  /// Null where the system does not let code be made, the processor is another one, the code would take more
  /// than a mebibyte of the stack, or the environment variable AVI_MACHINE_CODE is "off".
  /// @throws std::invalid_argument where that variable is neither "on" nor "off" nor empty.
  static std::unique_ptr<const MachineCode> of(std::span<const Program* const> programs,
                                               const MachineTarget& target);
  ~MachineCode();
  MachineCode(const MachineCode&) = delete;             ///< There is one.
  MachineCode& operator=(const MachineCode&) = delete;  ///< There is one.

  [[nodiscard]] Function operator[](std::size_t program) const { return functions_[program]; }  ///< That one.

 private:
  MachineCode() = default;
  void* memory_ = nullptr;
  std::size_t size_ = 0;
  std::vector<Function> functions_;
};

}  // namespace avi::detail
