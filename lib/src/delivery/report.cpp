#include "avi/solve.hpp"

#include <cmath>
#include <sstream>

namespace avi {

namespace {

/// The unit in which the work of choosing is counted: trials by splitting take kicks, others sweeps.
const char* unit_of_choosing(const Choice& choice) {
  bool kicks = choice.name == "splitting", sweeps = !kicks;
  for (const SolveTrial& trial : choice.trials)
    (trial.monitor == "splitting" ? kicks : sweeps) = true;
  return kicks && sweeps ? " sweeps and kicks" : kicks ? " kicks" : " sweeps";
}

}  // namespace

std::string SolutionReport::report() const {
  std::ostringstream text;
  text.precision(3);
  // The result, and whether it keeps what was promised.
  if (!ok())
    text << run.message << "\nNothing is promised of the state: the run did not come to its end.\n";
  else if (run.steps == 0)
    return "Kept: the end is the start, and no step was made.\n";
  else if (!kept() && std::isfinite(energy_error) && state_error == energy_error)  // which is the larger
    text << "Not kept: the energy errs by more than ten tolerances, so no more is promised of the end; "
         << "the tolerance is " << tolerance << ".\n";
  else if (std::isfinite(state_error))
    text << (kept() ? "Kept" : "Not kept") << ": the state errs by " << state_error
         << " of the range of a coordinate or momentum, as two runs with different steps "
         << (choice.check > 0 ? "show" : "foretell from their beginning") << "; the tolerance is "
         << tolerance << ".\n";
  else
    text << "Nothing is promised of the state at the end: "
         << (note.empty() ? "no second run was compared with it" : "its error is not known") << ".\n";
  text << "The largest error of the energy is " << energy_error << ", relative to the scale "
       << choice.energy_scale << ".\n";
  if (!note.empty()) text << note << "\n";
  const char* const counted = choice.name == "splitting" ? " kicks" : " sweeps";
  const auto steps = [](long count) { return count == 1 ? " step, " : " steps, "; };
  text << run.steps << steps(run.steps) << run.evaluations << counted << ": monitor " << choice.name
       << ", order " << choice.order << ", h = " << choice.h << ". Choosing took " << choice.sweeps
       << unit_of_choosing(choice);
  if (choice.check > 0) text << ", the second run " << choice.check;
  text << (choice.trials.empty() ? ".\n" : ". Runs on the way:\n");
  for (const SolveTrial& trial : choice.trials) {
    text << "  " << trial.monitor << ", order " << trial.order << ": h = " << trial.h << " for " << trial.time
         << ", " << trial.steps << steps(trial.steps) << trial.sweeps
         << (trial.monitor == "splitting" ? " kicks" : " sweeps");
    // The error of the run with the longer step of two is not known.
    if (std::isfinite(trial.state_error)) text << ", error " << trial.state_error;
    text << ", " << name(trial.outcome) << "\n";
  }
  return text.str();
}

}  // namespace avi
