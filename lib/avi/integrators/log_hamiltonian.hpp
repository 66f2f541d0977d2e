#pragma once
#include "avi/integrators/splitting.hpp"

#include <limits>
#include <utility>

/// @file
/// LogHamiltonian: the flows of the logarithmic Hamiltonian, for a time-transformed leapfrog.

namespace avi {

/// The flows of \f$\Gamma = \log(T(p) + p^t) - \log U(q)\f$ with \f$U = -V > 0\f$ and \f$p^t = -H_0\f$
/// (Mikkola and Tanikawa 1999; Preto and Tremaine 1999). In its fictive time, \f$dt = d\tau/(T + p^t)\f$,
/// they are \f[ \text{drift: } q \mathrel{+}= \frac{h}{T + p^t} \frac{\partial T}{\partial p}, \quad t
/// \mathrel{+}= \frac{h}{T + p^t}; \qquad \text{kick: } p \mathrel{+}= h \nabla U/U. \f] Both are exact, so a
/// Splitting of them is an explicit adaptive symplectic integrator; on the orbit its step in physical time is
/// h / U. For Kepler's problem the leapfrog stays on the exact ellipse and errs only in time. `Problem`
/// provides `dimension`, kinetic(p), potential(q), potential_gradient(q), and velocity(p),
/// \f$\partial T/\partial p\f$, unless all masses are 1. If it also provides log_potential_gradient(q,
/// s) = s grad log U, the root in U is not computed. A run ends as Outcome::diverged where U = 0, a place
/// that no orbit in fictive time passes.
template <class Problem>
class LogHamiltonian {
 public:
  static constexpr int dimension = Problem::dimension;  ///< Entries of q and of p.
  using Vec = Vector<double, dimension>;                ///< A position or a momentum.

  /// @param problem copied @param p_t the momentum conjugate to time, minus the energy of the orbit
  /// @throws std::invalid_argument unless p_t is finite, and T is half the square of p or there is
  /// velocity(p)
  LogHamiltonian(Problem problem, double p_t)
      : problem_(std::move(problem)), p_t_(require_finite("Conjugate of time p^t", p_t)) {
    if constexpr (!requires(const Vec& p) { problem_.velocity(p); })
      detail::require_unit_masses<dimension>([this](const Vec& p) { return problem_.kinetic(p); });
  }

  /// Takes p^t = -H(q, p) from the start. Orbits of another energy need a separate object.
  /// @throws std::invalid_argument unless the potential is negative at the start.
  LogHamiltonian(Problem problem, const State<dimension>& start)
      : LogHamiltonian(problem, -(problem.kinetic(start.p) + problem.potential(start.q))) {
    const double potential = problem.potential(start.q);
    require(potential < 0.0, "Potential at the start", potential, "negative for the logarithmic Hamiltonian");
  }

  /// Change of q and t in a drift over h.
  [[nodiscard]] Drift<dimension> drift(const Vec& p, double h) const {
    const double dt = h / (problem_.kinetic(p) + p_t_);
    if constexpr (requires { problem_.velocity(p); })
      return {dt * problem_.velocity(p), dt};
    else
      return {dt * p, dt};
  }

  /// Change of p in a kick over h; NaN, which no valid state contains, where U is not positive.
  [[nodiscard]] Vec kick(const Vec& q, double h) const {
    if constexpr (shortcut) {
      return problem_.log_potential_gradient(q, h);
    } else {
      const double potential = problem_.potential(q);
      return (potential < 0.0 ? h / potential : std::numeric_limits<double>::quiet_NaN()) *
             problem_.potential_gradient(q);
    }
  }

  /// True where T + p^t and U are positive, as they are on every orbit. Otherwise h was too large, or the
  /// orbit leads to U = 0, where its fictive time ends. For a problem with log_potential_gradient(), U > 0 is
  /// assumed.
  [[nodiscard]] bool admits(const State<dimension>& z) const {
    bool inside = problem_.kinetic(z.p) + p_t_ > 0.0;
    if constexpr (!shortcut) inside = inside && problem_.potential(z.q) < 0.0;
    return inside;
  }

 private:
  static constexpr bool shortcut = requires(const Problem& problem, const Vec& q) {
    problem.log_potential_gradient(q, 1.0);
  };
  Problem problem_;
  double p_t_;
};

}  // namespace avi
