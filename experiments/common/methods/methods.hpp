#pragma once
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "common/methods/method_of_orbit.hpp"

#include <cmath>
#include <string>
#include <type_traits>

// The methods that the experiments drive to their limits. Those for Kepler's problem take p^t from the start.
// Their monitors are chosen at run time, so that one compiled method serves all of them.

namespace experiment {

/// A monitor g(q) of the given kind.
struct PositionMonitor {
  enum Kind { none, power_of_radius, arclength } kind = none;
  double exponent = 1.0;  ///< Exponent of r = |q|.
  double energy = -0.5;   ///< H_0.

  auto operator()(const auto& q) const {
    using S = std::decay_t<decltype(q[0] * q[0])>;
    if (kind == none) return S(1.0);
    return kind == power_of_radius ? S(avi::Gamma{0.5 * exponent}(q))
                                   : S(avi::Arclength{avi::Kepler{}, energy}(q));
  }
};

/// A monitor g(q, p) of the given kind, bounded as by avi::Bounded if b is finite.
struct MomentumMonitor {
  enum Kind { energy, inverse_lagrangian, inverse_energy_error } kind = energy;
  double energy_momentum = 0.5;  ///< p^t = -H_0.
  double a = 0.0, b = HUGE_VAL;  ///< Lower and upper bound of the monitor.

  auto operator()(const auto& q, const auto& p) const {
    using std::abs;
    using S = std::decay_t<decltype(q[0] * p[0])>;
    const S g = kind == inverse_energy_error
                    ? S(1.0 / abs(energy_momentum + avi::Kepler{}(q, p)))
                    : S(avi::Energy{avi::Kepler{}, kind == energy ? energy_momentum : 0.0}(q, p));
    return std::isfinite(b) ? S(b * (g + a) / (g + b)) : g;
  }
};

/// The Type II HTVI of the stationary construction, of an even order: Taylor order r = order / 2 - 1 and the
/// Gauss rule with r + 1 nodes. It is avi::htvi<order>() with the order given at run time.
Method2 stationary(int order, PositionMonitor monitor);
Method2 stationary(int order, MomentumMonitor monitor);
/// The same for the Henon-Heiles problem, without a monitor.
Method2 stationary_henon_heiles(int order);

/// Gauss collocation of this order, for Kepler's problem and for the Henon-Heiles problem.
Method2 collocation(int order, PositionMonitor monitor);
Method2 collocation_henon_heiles(int order);

/// Explicit methods for Kepler's problem, by name: stormer_verlet, yoshida4, kahan_li8, runge_kutta_4; and
/// with steps that follow 1/V, log_hamiltonian and log_hamiltonian_yoshida4, or r^1.5, adaptive_verlet and
/// hairer_soderlind.
/// @throws std::invalid_argument for another name.
Method2 explicit_on_kepler(const std::string& name);
/// The same for the Henon-Heiles problem: stormer_verlet, yoshida4, kahan_li8, runge_kutta_4.
Method2 explicit_on_henon_heiles(const std::string& name);

}  // namespace experiment
