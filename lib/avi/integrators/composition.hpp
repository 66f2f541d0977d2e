#pragma once
#include "avi/core/integrate.hpp"
#include "avi/integrators/split_coefficients.hpp"

#include <array>
#include <utility>

/// @file
/// Composition of any symmetric method with itself.

namespace avi {

/// S(c_1 h) S(c_2 h) ... S(c_m h): a symmetric method of order 2 becomes one of coefficients.order, and
/// keeps being symmetric, symplectic, reversible where S is. The base may carry variables of its own (an
/// adaptive one does).
template <class Base, int m>
class Composition {
 public:
  Composition(Base base, const CompositionCoefficients<m>& coefficients) : base_(std::move(base)) {
    for (std::size_t i = 0; i < c_.size(); ++i)
      c_[i] = static_cast<double>(coefficients.c[i]);
  }

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
        return total;
      }
    }
    return total;
  }

  [[nodiscard]] const Base& base() const { return base_; }

 private:
  Base base_;
  std::array<double, static_cast<std::size_t>(m)> c_;
};

}  // namespace avi
