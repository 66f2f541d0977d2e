#pragma once
#include "budget.hpp"

/// @file
/// The choice of monitor, order and step for an orbit.

namespace avi::detail {

/// Chooses what takes an orbit to its end within the tolerance, and the end: what was asked for on the way is
/// not delivered. The question has been checked, and has some time to go.
OrbitAnswer choose(const OrbitQuestion& question, Budget& budget);

/// \f$H_0\f$, the constant in g (H - H_0), with all of its digits: an error of it is one of all runs, which
/// they do not see of each other.
double energy_at_start(const OrbitQuestion& question);

/// @throws std::invalid_argument, with H and where it is taken, unless the energy at the start is finite.
void require_energy(double energy, const OrbitQuestion& question);

}  // namespace avi::detail
