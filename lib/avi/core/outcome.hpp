#pragma once
#include "avi/core/compiler.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

/// @file
/// How a step and a run end. Nothing in the library returns a number without saying which of these it is.

namespace avi {

/// End of one step or of a whole run.
enum class Outcome {
  ok,             ///< Reached what was asked for.
  stopped,        ///< An observer asked to stop.
  step_limit,     ///< The cap on steps was reached first.
  not_converged,  ///< An implicit equation was not solved; the state is the last good one.
  non_finite,     ///< A value became infinite or NaN; the state is the last good one.
  bad_monitor,    ///< The monitor g = dt/dtau was not positive; the state is the last good one.
  stalled,     ///< Physical time stands still, or so nearly that the run would never arrive; rounding of the
               ///< objective hides what a minimisation could still gain.
  diverged,    ///< The iterates left every bound that the caller set; the last good one is kept.
  no_descent,  ///< The objective does not fall where its gradient says so; the last good iterate is kept.
  wrong_gradient,  ///< The gradient contradicts differences of values, or has another size than x.
  time_limit       ///< The cap on seconds was reached first.
};

/// The name used in messages and data files.
constexpr std::string_view name(Outcome outcome) {
  constexpr std::string_view names[] = {"ok",         "stopped",        "step_limit", "not_converged",
                                        "non_finite", "bad_monitor",    "stalled",    "diverged",
                                        "no_descent", "wrong_gradient", "time_limit"};
  return names[static_cast<int>(outcome)];
}

/// The report of one step to the run loop.
struct [[nodiscard]] StepReport {
  Outcome outcome = Outcome::ok;  ///< Unless ok, the state is as it was.
  /// Evaluations of the vector field or of its Taylor expansion; one that is kept for the next step counts
  /// there alone, so that the one at the start of a run does not.
  int evaluations = 1;
  /// Residual of the implicit equation, 0 for explicit steps. One of these that ends as non_finite has -k
  /// here where entry k of (q, p, t), counted from 1, is the first that is not finite.
  double residual = 0.0;

  /// True for Outcome::ok alone.
  [[nodiscard]] bool ok() const { return outcome == Outcome::ok; }
};

/// An observer's answer: how a run ends there unless ok, and why.
struct [[nodiscard]] Answer {
  Outcome outcome = Outcome::ok;  ///< Unless ok, the run ends.
  std::string reason{};           ///< A clause for the message of the run, such as "g is nan".
};

/// The report of a run to its caller.
struct [[nodiscard]] Run {
  Outcome outcome = Outcome::ok;  ///< ok when the end asked for was reached.
  long steps = 0;                 ///< Steps that were accepted.
  /// Sum over those steps, and those that were tried to end the run where it does; what observers try, as an
  /// event on the way, is not in it.
  long evaluations = 0;
  std::string message;  ///< Empty for ok; else one sentence with step, time and reason.

  /// True for Outcome::ok alone: the end asked for was reached.
  [[nodiscard]] bool ok() const { return outcome == Outcome::ok; }
};

/// @cond
namespace detail {
/// So small a step h may lead to no change of time at all, whatever the monitor.
inline bool underflows(double h) {
  return std::abs(h) < std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
}
}  // namespace detail
/// @endcond

}  // namespace avi
