#pragma once
#include "avi/automatic/phase_function.hpp"
#include "avi/core/outcome.hpp"

#include <sstream>
#include <string>
#include <vector>

/// @file
/// What a pilot run tried and chose.

namespace avi {

/// One short run of a pilot.
struct Trial {
  std::string monitor;            ///< Name in the menu.
  double h = 0.0;                 ///< Fictive step.
  long steps = 0;                 ///< Taken.
  long sweeps = 0;                ///< Evaluations of all stages.
  double energy_error = 0.0;      ///< Largest |H - H_0| over the energy scale; infinite where the run failed.
  Outcome outcome = Outcome::ok;  ///< How it ended.
};

/// A monitor with the step that goes with it. From here on both are fixed, and a method is the symplectic map
/// that it would be with a monitor made by hand.
struct MonitorChoice {
  std::string name;           ///< In the menu: see choose_monitor().
  PhaseFunction monitor;      ///< g.
  int order = 0;              ///< Of the collocation method that it was chosen for.
  double h = 0.0;             ///< Fictive step for the energy error asked for.
  bool reached = false;       ///< A trial met the energy error asked for.
  double energy_scale = 1.0;  ///< What energy errors are relative to, see choose_monitor().
  double time = 0.0;          ///< Physical time of a trial.
  long sweeps = 0;            ///< Evaluations of all stages in all trials, what the pilot cost.
  double work = 0.0;          ///< The same in additions, the rough tour along the orbit included.
  std::vector<Trial> trials;  ///< In their order.
  std::string note;           ///< Why the menu was short; empty where it was not.

  /// The trials as a table and what follows from them.
  [[nodiscard]] std::string report() const {
    std::ostringstream text;
    text.precision(3);
    for (const Trial& trial : trials)
      text << "  " << trial.monitor << ": h = " << trial.h << ", " << trial.steps << " steps, "
           << trial.sweeps << " sweeps, energy error " << trial.energy_error << ", "
           << avi::name(trial.outcome) << "\n";
    if (!note.empty()) text << "  " << note << "\n";
    if (reached)
      text << "Chosen: " << name << ", order " << order << ", h = " << h
           << ", the least work for the energy error asked for in a pilot of time " << time << " (" << sweeps
           << " sweeps).\n";
    else
      text << "No monitor of the menu reached the energy error asked for in a pilot of time " << time
           << ".\n";
    return text.str();
  }
};

}  // namespace avi
