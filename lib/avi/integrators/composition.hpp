#pragma once
#include "avi/core/integrate.hpp"
#include "avi/integrators/coefficient_lists.hpp"

#include <algorithm>
#include <utility>

/// @file
/// Composition of any symmetric method with itself.

namespace avi {

/// \f$S(c_1 h)\, S(c_2 h) \cdots S(c_m h)\f$: makes of a symmetric method S of order 2 one of
/// coefficients.order, which is symmetric, and symplectic and reversible where S is. The base may carry
/// variables of its own (an adaptive one does).
template <class Base>
class Composition {
  static_assert(
      requires { requires Base::symmetric; }, "The base of a composition must declare that it is symmetric: "
                                              "of another one the order stays what it is.");

 public:
  /// The composition of this base by one of avi::compositions.
  /// @throws std::invalid_argument unless the coefficients are the same read backwards, with sum 1.
  Composition(Base base, const CompositionCoefficients& coefficients)
      : base_(std::move(base)), order_(coefficients.order), c_(coefficients.c) {
    c_.validate("List of composition coefficients");
  }

  [[nodiscard]] int order() const { return order_; }        ///< That of the coefficients.
  static constexpr bool symplectic = Base::symplectic;      ///< As the base is.
  static constexpr bool symmetric = true;                   ///< As the base is.
  static constexpr bool one_step = detail::one_step<Base>;  ///< As the base is.

  /// m steps of the base; their evaluations are added, the largest residual is kept. Where one of them fails
  /// the state is that before the first, and the outcome and the residual are its own.
  template <class State>
  requires Method<Base, State> StepReport step(State& z, double h) {
    const State start = z;
    StepReport total{.evaluations = 0};
    for (double c : c_) {
      const StepReport part = base_.step(z, c * h);
      total.evaluations += part.evaluations;
      total.residual = std::max(total.residual, part.residual);
      if (part.outcome != Outcome::ok) {
        z = start;
        total.outcome = part.outcome;
        total.residual = part.residual;
        return total;
      }
    }
    return total;
  }

 private:
  Base base_;
  int order_;
  Lengths<double> c_;
};

}  // namespace avi
