#pragma once
#include "beyond/speed/automatic_monitors/scenes.hpp"

#include "common/frame.hpp"

/// @file
/// The drift of the energy with what solve() chooses, measured.

namespace experiment {

/// Energy errors over `repeats` times the horizon of each scene with one choice of solve(), and the slope
/// of a line through them: table <name>_drift.
void measure_drift(const Frame& frame, const std::vector<Scene>& scenes, int repeats);

}  // namespace experiment
