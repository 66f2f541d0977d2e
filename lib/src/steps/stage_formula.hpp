#pragma once
#include "avi/autodiff/pack.hpp"
#include "src/autodiff/pack_functions.hpp"
#include "src/steps/formulas.hpp"

#include <cstddef>
#include <memory>
#include <optional>

/// @file
/// A program at several points side by side, for files that are compiled once for each set of instructions.
/// Nothing in here is visible outside of those files.

namespace avi::detail {

namespace {

/// Whether code is made at run time on the machine that this file is compiled for.
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
constexpr bool makes_code = true, has_avx512 = true;
#elif defined(__AVX2__)
constexpr bool makes_code = true, has_avx512 = false;
#else
constexpr bool makes_code = false, has_avx512 = false;
#endif

/// Returns the machine code of formulas, made at the first call; null where none is wanted or can be made.
template <int w>
std::shared_ptr<const MachineCode> machine_code(const Formulas& formulas) {
  if constexpr (makes_code) {
    if (!formulas.code) return nullptr;
    const Program* const programs[] = {&formulas.forces, &formulas.velocities, &formulas.rate};
    return formulas.code->of({programs, formulas.unit ? 2u : 3u},
                             {.lanes = w,
                              .avx512 = has_avx512,
                              .functions = pack_functions<w>(),
                              .parameters = static_cast<int>(formulas.parameters.size())});
  }
  return nullptr;
}

/// A program that is evaluated at packs of w numbers.
template <int w>
class StageFormula {
 public:
  /// Takes a program. @param parameters its last arguments @param code machine code of several programs, of
  /// which this is number `place`; null where there is none
  StageFormula(const Program& program, const std::vector<double>& parameters, const MachineCode* code,
               std::size_t place)
      : program_(&program), code_(code ? (*code)[place] : nullptr) {
    if (!code) room_.emplace(program);
    if (parameters.empty() || program.inputs() == 0) return;
    factors_.assign(1, Pack<w>(1.0));
    factors_.insert(factors_.end(), parameters.begin(), parameters.end());
    if (room_)
      std::copy(factors_.begin() + 1, factors_.end(),
                room_->arguments() + program.inputs() - static_cast<int>(parameters.size()));
  }

  /// Sets `out` to factor times the derivatives, or to the value if there are no derivatives.
  template <class Vec>
  [[gnu::always_inline]] void run(const Vec& q, const Vec& p, const Pack<w>& factor, Pack<w>* out) {
    if (!code_) return interpret(q, p, factor, out);
    const Pack<w>* factors = &factor;
    if (!factors_.empty()) factors_[0] = factor, factors = factors_.data();
    code_(number(q.data()), number(p.data()), number(factors), number(out));
  }

 private:
  static const double* number(const Pack<w>* x) { return reinterpret_cast<const double*>(x); }
  static double* number(Pack<w>* x) { return reinterpret_cast<double*>(x); }
  template <class Vec>
  [[gnu::noinline]] void interpret(const Vec& q, const Vec& p, const Pack<w>& factor, Pack<w>* out) {
    Pack<w>* const z = room_->arguments();
    const Eigen::Index size = q.size();
    for (Eigen::Index i = 0; i < size; ++i) {
      z[i] = q[i];
      z[size + i] = p[i];
    }
    program_->run(*room_);
    if (program_->slopes() == 0) out[0] = program_->value(*room_);
    for (int i = 0; i < program_->slopes(); ++i)
      out[i] = factor * program_->slope(*room_, i);
  }

  const Program* program_;
  MachineCode::Function code_;
  std::optional<Program::Room<Pack<w>>> room_;                       // memory, where there is no code
  std::vector<Pack<w>, Eigen::aligned_allocator<Pack<w>>> factors_;  // the factor and the parameters, if any
};

}  // namespace

}  // namespace avi::detail
