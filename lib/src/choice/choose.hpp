#pragma once
#include "src/choice/budget.hpp"

/// @file
/// The choice of monitor, order and step for an orbit.

namespace avi::detail {

/// Chooses monitor, order and step for an orbit, and follows it to its end within the tolerance. Output times
/// and events are left to the caller. The question has been checked.
OrbitAnswer choose(const OrbitQuestion& question, Budget& budget);

/// The energy at the start, \f$H_0\f$, the constant in \f$g\,(H - H_0)\f$, correct to the last digit: all
/// runs share its error, so comparing them would not show it.
double energy_at_start(const OrbitQuestion& question);

/// Requires a finite energy at the start. @throws std::invalid_argument otherwise, with H and the point where
/// it is taken
void require_energy(double energy, const OrbitQuestion& question);

}  // namespace avi::detail
