#pragma once
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "common/methods/method_of_orbit.hpp"

#include <cmath>
#include <string>
#include <type_traits>

// The methods that are driven to their limits. Those on Kepler's problem take p^t from the start. Their
// monitors are chosen at run time: one compiled method for all of them.

namespace experiment {

/// g(q) of one kind.
struct PositionMonitor {
  enum Kind { none, power_of_radius, arclength } kind = none;
  double exponent = 1.0;  ///< The power of r = |q|.
  double energy = -0.5;   ///< H_0.

  auto operator()(const auto& q) const {
    using S = std::decay_t<decltype(q[0] * q[0])>;
    if (kind == none) return S(1.0);
    return kind == power_of_radius ? S(avi::Gamma{0.5 * exponent}(q))
                                   : S(avi::Arclength{avi::Kepler{}, energy}(q));
  }
};

/// g(q, p) of one kind, bounded by avi::Bounded's formula where b is finite.
struct MomentumMonitor {
  enum Kind { energy, inverse_lagrangian, inverse_energy_error } kind = energy;
  double energy_momentum = 0.5;  ///< p^t = -H_0.
  double a = 0.0, b = HUGE_VAL;  ///< Its bounds.

  auto operator()(const auto& q, const auto& p) const {
    using std::abs;
    using S = std::decay_t<decltype(q[0] * p[0])>;
    const S g = kind == inverse_energy_error
                    ? S(1.0 / abs(energy_momentum + avi::Kepler{}(q, p)))
                    : S(avi::Energy{avi::Kepler{}, kind == energy ? energy_momentum : 0.0}(q, p));
    return std::isfinite(b) ? S(b * (g + a) / (g + b)) : g;
  }
};

/// Type II HTVI of the stationary construction and this even order: Taylor order r = order / 2 - 1, the Gauss
/// rule of r + 1 nodes. That is avi::htvi<order>() with the order chosen at run time.
Method2 stationary(int order, PositionMonitor monitor);
Method2 stationary(int order, MomentumMonitor monitor);
/// The same on Henon and Heiles' problem, without a monitor.
Method2 stationary_henon_heiles(int order);

/// Gauss collocation of this order, and the same on Henon and Heiles' problem.
Method2 collocation(int order, PositionMonitor monitor);
Method2 collocation_henon_heiles(int order);

/// Explicit methods, by name: stormer_verlet, yoshida4, kahan_li8, runge_kutta_4, and with a step that
/// follows r^1.5 (the first three) or 1/V: log_hamiltonian, log_hamiltonian_yoshida4, adaptive_verlet,
/// hairer_soderlind.
/// @throws std::invalid_argument for another name.
Method2 explicit_on_kepler(const std::string& name);
/// Same, for stormer_verlet, yoshida4, kahan_li8, runge_kutta_4.
Method2 explicit_on_henon_heiles(const std::string& name);

}  // namespace experiment
