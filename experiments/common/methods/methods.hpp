#pragma once
#include "common/methods/any_monitor.hpp"
#include "common/methods/runner.hpp"

/// @file
/// The methods that are driven to their limits. Those on Kepler's problem take p^t from the start.

namespace experiment {

/// Type II HTVI of order r + 1 with the Gauss rule of that order.
Runner htvi(int r, PositionMonitor monitor);
Runner htvi(int r, MomentumMonitor monitor);
/// The same on Henon and Heiles' problem, without a monitor.
Runner htvi_henon_heiles(int r);

/// Gauss collocation of this order, and the same on Henon and Heiles' problem.
Runner collocation(int order, PositionMonitor monitor);
Runner collocation_henon_heiles(int order);

/// Explicit methods, by name: stormer_verlet, yoshida4, kahan_li8, runge_kutta_4, and with a step that
/// follows r^1.5 (the first three) or 1/V: log_hamiltonian, log_hamiltonian_yoshida4, adaptive_verlet,
/// hairer_soderlind.
/// @throws std::invalid_argument for another name.
Runner explicit_on_kepler(const std::string& name);
/// Same, for stormer_verlet, yoshida4, kahan_li8, runge_kutta_4.
Runner explicit_on_henon_heiles(const std::string& name);

}  // namespace experiment
