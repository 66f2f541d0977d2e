#include "avi/solve.hpp"

#include <sstream>

namespace avi {

std::string SolutionReport::report() const {
  std::ostringstream text;
  text.precision(3);
  if (!ok()) text << run.message << "\n";
  text << run.steps << " steps, " << run.evaluations << " sweeps: monitor " << choice.name << ", order "
       << choice.order << ", h = " << choice.h << "; chosen in " << choice.sweeps << " sweeps of "
       << choice.trials.size() << " trials.\n";
  text << "State at the end: error about " << state_error << ", tolerance " << tolerance
       << "; largest energy error " << energy_error << " of the scale " << choice.energy_scale << ".\n";
  if (!note.empty()) text << note << "\n";
  for (const SolveTrial& trial : choice.trials)
    text << "  " << trial.monitor << ", order " << trial.order << ": h = " << trial.h << " for " << trial.time
         << ", " << trial.steps << " steps, " << trial.sweeps << " sweeps, error " << trial.state_error
         << ", " << name(trial.outcome) << "\n";
  return text.str();
}

}  // namespace avi
