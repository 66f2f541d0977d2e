#pragma once
#include "avi/core/integrate.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <utility>

// Time-reversible control of the step size.

namespace experiment {

using avi::State, avi::StepReport, avi::Outcome, avi::Method;

/// The monitor g = |q|^alpha of a body of unit mass, in the form that HairerSoderlind needs.
struct PowerOfRadius {
  double alpha = 1.5;  ///< Exponent; 3/2 corresponds to Kepler's third law.

  /// g(q, p).
  double operator()(const auto& q, const auto&) const { return std::pow(q.squaredNorm(), 0.5 * alpha); }

  /// \f$d(1/g)/d\tau = -(\nabla g\cdot f)/g = -\alpha\, q\cdot p/|q|^2\f$ along the flow \f$dt = g\,d\tau\f$.
  double density_rate(const auto& q, const auto& p) const { return -alpha * q.dot(p) / q.squaredNorm(); }
};

/// A symmetric method with step size h / rho, where rho follows 1 / g by integration instead of evaluation
/// (Hairer and Soderlind, Explicit, time reversible, adaptive step size control, 2005).
/// \f[ \rho_{1/2} = \rho_0 + \tfrac{h}{2} G(q_0, p_0), \quad
/// (q_1, p_1) = \Phi_{h/\rho_{1/2}}(q_0, p_0), \quad
/// \rho_1 = \rho_{1/2} + \tfrac{h}{2} G(q_1, p_1), \quad G = -(\nabla g\cdot f)/g. \f]
///
/// It is explicit if Phi is, symmetric, reversible and of the order of Phi, but not symplectic. `Base` is
/// Phi, any symmetric Method. `Monitor` provides g(q, p), for the start, and density_rate(q, p) = G. If the
/// state was changed from outside, rho is reset to 1 / g.
template <class Base, class Monitor>
class HairerSoderlind {
 public:
  /// The controlled method from a symmetric base and a monitor.
  HairerSoderlind(Base base, Monitor monitor) : base_(std::move(base)), monitor_(std::move(monitor)) {}

  /// The order of the base.
  [[nodiscard]] int order() const { return base_.order(); }
  static constexpr bool symplectic = false;  ///< Because of the density.
  static constexpr bool symmetric = true;    ///< With the density as part of the state.
  static constexpr bool one_step = false;    ///< A step depends on the density, not on the state alone.

  /// Ends as Outcome::diverged if the density is not positive: h is then too large for this monitor.
  template <int n>
  StepReport step(State<n>& z, double h) {
    static_assert(Method<Base, State<n>>, "The base must be a method for states of this dimension.");
    // A rate or time other than that after the last step shows that the state was changed from outside.
    const double start_rate = monitor_.density_rate(z.q, z.p);
    const bool known = start_rate == rate_ && z.t == time_;
    const double rho = (known ? rho_ : 1.0 / monitor_(z.q, z.p)) + 0.5 * h * start_rate;
    if (!(rho > 0.0)) return {.outcome = Outcome::diverged};
    const StepReport report = base_.step(z, h / rho);
    if (report.outcome != Outcome::ok) return report;
    rate_ = monitor_.density_rate(z.q, z.p);
    rho_ = rho + 0.5 * h * rate_;
    time_ = z.t;
    return report;
  }

 private:
  Base base_;
  Monitor monitor_;
  double rho_{}, rate_{};
  double time_ = std::nan("");  // equal to no time: nothing is known yet
};

}  // namespace experiment
