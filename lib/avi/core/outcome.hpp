#pragma once
#include "avi/core/compiler.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

/// @file
/// The outcomes of steps and runs, and their reports. Every result of the library carries an outcome.

namespace avi {

/// How a step or a whole run ended.
enum class Outcome {
  ok,             ///< The goal of the run was reached.
  stopped,        ///< An observer asked to stop.
  step_limit,     ///< The limit on steps was reached first.
  not_converged,  ///< An implicit equation was not solved; the state is the last good one.
  non_finite,     ///< A value became infinite or NaN; the state is the last good one.
  bad_monitor,    ///< The monitor g = dt/dtau was not positive; the state is the last good one.
  /// Physical time stands still, or advances so slowly that the run would never end; in a minimisation,
  /// rounding of the objective hides any further gain.
  stalled,
  diverged,    ///< The iterates exceeded their bounds, or a step leads where the method is not defined; the
               ///< last valid one is kept.
  no_descent,  ///< The objective does not fall where its gradient says so; the last valid iterate is kept.
  wrong_gradient,  ///< The gradient contradicts differences of values, or does not have the size of x.
  time_limit       ///< The limit on seconds was reached first.
};

/// The name of an outcome in messages and data files.
constexpr std::string_view name(Outcome outcome) {
  constexpr std::string_view names[] = {"ok",         "stopped",        "step_limit", "not_converged",
                                        "non_finite", "bad_monitor",    "stalled",    "diverged",
                                        "no_descent", "wrong_gradient", "time_limit"};
  return names[static_cast<int>(outcome)];
}

/// The report of a step to the loop of a run.
struct [[nodiscard]] StepReport {
  Outcome outcome = Outcome::ok;  ///< If not ok, the state is unchanged.
  /// Evaluations of the vector field or of its Taylor expansion. An evaluation that ends a step and is
  /// kept for the next one counts once; the additional one at the start of a run does not count.
  int evaluations = 1;
  double residual = 0.0;  ///< Residual of the implicit equation; 0 for explicit steps.
  /// The first entry of (q, p, t), counted from 0, that is not finite after an explicit step that ends as
  /// non_finite; otherwise -1.
  int bad_entry = -1;

  /// True for Outcome::ok only.
  [[nodiscard]] bool ok() const { return outcome == Outcome::ok; }
};

/// The answer of an observer: how the run is to end, unless ok, and why.
struct [[nodiscard]] Answer {
  Outcome outcome = Outcome::ok;  ///< If not ok, the run ends.
  std::string reason{};           ///< A clause for the message of the run, such as "g is nan".

  /// True for Outcome::ok only.
  [[nodiscard]] bool ok() const { return outcome == Outcome::ok; }
};

/// The report of a run to its caller.
struct [[nodiscard]] Run {
  Outcome outcome = Outcome::ok;  ///< ok where the run reached its end.
  long steps = 0;                 ///< Accepted steps.
  /// Evaluations in those steps, and in the shorter steps that were tried to end the run exactly. Steps tried
  /// by observers, such as on_event(), are not included.
  long evaluations = 0;
  std::string message;  ///< Empty for ok; otherwise one sentence with step, time and reason.

  /// True for Outcome::ok only: the run reached its end.
  [[nodiscard]] bool ok() const { return outcome == Outcome::ok; }
};

/// @cond
namespace detail {
/// True where a step h is so small that, with any monitor, time may not change at all.
inline bool underflows(double h) {
  return std::abs(h) < std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
}
}  // namespace detail
/// @endcond

}  // namespace avi
