#pragma once
#include "avi/core/integrate.hpp"
#include "avi/integrators/coefficient_lists.hpp"

#include <algorithm>
#include <utility>

/// @file
/// Composition of a symmetric method with itself, to a higher order.

namespace avi {

/// The composition \f$S(c_1 h)\, S(c_2 h) \cdots S(c_m h)\f$ of a symmetric method S of order 2. It has the
/// order coefficients.order and is symmetric; it is symplectic and reversible where S is. The base may have
/// internal variables, as adaptive methods do.
template <class Base>
class Composition {
  static_assert(
      requires { requires Base::symmetric; }, "The base of a composition must declare that it is symmetric: "
                                              "of another one the order stays what it is.");

 public:
  /// Composes this base with one of avi::compositions.
  /// @throws std::invalid_argument unless the coefficients are a palindrome with sum 1.
  Composition(Base base, const CompositionCoefficients& coefficients)
      : base_(std::move(base)), order_(coefficients.order), c_(coefficients.c) {
    c_.validate("List of composition coefficients");
  }

  [[nodiscard]] int order() const { return order_; }        ///< The order of the coefficients.
  static constexpr bool symplectic = Base::symplectic;      ///< As for the base.
  static constexpr bool symmetric = true;                   ///< As for the base.
  static constexpr bool one_step = detail::one_step<Base>;  ///< As for the base.

  /// Takes m steps of the base. The report adds up the evaluations and contains the largest residual. If a
  /// step fails, z is unchanged, and the report has the outcome, residual and bad_entry of that step.
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
        total.bad_entry = part.bad_entry;
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
