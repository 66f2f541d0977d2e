#pragma once
#include "beyond/speed/automatic_monitors/scenes.hpp"

#include "common/frame.hpp"

/// @file
/// What energy_run(H, start, t_end, tolerance) promises, measured.

namespace experiment {

/// Energy errors against the tolerances asked for, 1e-4 to 1e-11: table <name>_tolerance.
void measure_tolerances(const Frame& frame, const std::vector<Scene>& scenes);

/// Energy errors over `repeats` times the horizon of each scene with a monitor chosen once, and the slope of
/// a line through them: table <name>_drift.
void measure_drift(const Frame& frame, const std::vector<Scene>& scenes, int repeats);

}  // namespace experiment
