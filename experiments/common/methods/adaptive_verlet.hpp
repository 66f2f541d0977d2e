#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <utility>

// The adaptive Verlet method.

namespace experiment {

using avi::State, avi::StepReport, avi::Outcome, avi::Vector, avi::dynamic;

/// Adaptive Verlet of Huang and Leimkuhler (The adaptive Verlet method, 1997) for H = |p|^2 / 2 + V(q), with
/// a density rho = 1 / g as an additional variable.
/// \f{align*}{
/// p_{1/2} &= p_0 - \tfrac{h}{2\rho_0} \nabla V(q_0), & q_{1/2} &= q_0 + \tfrac{h}{2\rho_0}\, p_{1/2},
/// \\ \rho_1 &= 2/g(q_{1/2}, p_{1/2}) - \rho_0, & t_1 &= t_0 + \tfrac{h}{2} (1/\rho_0 + 1/\rho_1),
/// \\ q_1 &= q_{1/2} + \tfrac{h}{2\rho_1}\, p_{1/2}, & p_1 &= p_{1/2} - \tfrac{h}{2\rho_1} \nabla V(q_1).
/// \f}
///
/// The method is explicit, of order 2, symmetric and reversible, so it can be composed; it is not symplectic.
/// `Problem` provides potential_gradient(q), `Monitor` g(q, p) > 0. The gradient and rho are kept from step
/// to step. If the state was changed from outside, they are computed again, with rho = 1 / g.
template <class Problem, class Monitor>
class AdaptiveVerlet {
 public:
  static constexpr int n = Problem::dimension;  ///< Dimension of the problem.
  static constexpr int order() { return 2; }    ///< In the step size h.
  static constexpr bool symplectic = false;     ///< Because of the density.
  static constexpr bool symmetric = true;       ///< With the density as part of the state.
  static constexpr bool one_step = false;       ///< A step depends on the density, not on the state alone.

  static_assert(n != dynamic, "Adaptive Verlet needs a dimension known at compile time.");

  /// The method with fictive time dt/dtau = g for this monitor.
  AdaptiveVerlet(Problem problem, Monitor monitor)
      : problem_(std::move(problem)), monitor_(std::move(monitor)) {}

  /// Ends as Outcome::diverged if the density is not positive: h is then too large for this monitor.
  StepReport step(State<n>& z, double h) {
    double rho = rho_;
    Vector<double, n> force = force_;
    if (!(z == after_)) {
      rho = 1.0 / monitor_(z.q, z.p);
      if (!(rho > 0.0)) return {.outcome = Outcome::bad_monitor};
      force = problem_.potential_gradient(z.q);
    }
    State<n> w = z;
    const double before = 0.5 * h / rho;
    w.p -= before * force;
    w.q += before * w.p;
    rho = 2.0 / monitor_(w.q, w.p) - rho;
    if (!(rho > 0.0)) return {.outcome = Outcome::diverged};
    const double after = 0.5 * h / rho;
    w.q += after * w.p;
    force_ = problem_.potential_gradient(w.q);
    w.p -= after * force_;
    w.t += before + after;
    rho_ = rho;
    z = after_ = w;
    return {};
  }

 private:
  Problem problem_;
  Monitor monitor_;
  double rho_{};
  Vector<double, n> force_ = Vector<double, n>::Zero();
  State<n> after_{.q = force_, .p = force_, .t = std::nan("")};
};

}  // namespace experiment
