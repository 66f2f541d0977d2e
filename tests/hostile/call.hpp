#pragma once
#include "hostile/system.hpp"

#include <string>
#include <vector>

/// @file
/// One call of the front door, in a process of its own, so that one that crashes or does not end is a result
/// too.

namespace hostile {

/// What came of a call.
struct Answer {
  bool returned = false;         ///< With a solution; else `message` says how the call ended.
  bool crashed = false;          ///< By a signal.
  bool too_slow = false;         ///< Stopped after its seconds.
  bool ok = false;               ///< Of the solution, as the following.
  bool kept = false;             ///< The promise is given.
  std::string outcome = "none";  ///< Of the run.
  std::string message;           ///< Of the run, of the exception, or about the signal.
  std::string report;            ///< Of the solution.
  double state_error = 0.0, energy_error = 0.0;
  long steps = 0, evaluations = 0;
  std::vector<double> q, p;  ///< Last state.
  double t = 0.0;            ///< Its time.
  double seconds = 0.0;      ///< Of the processor.
};

/// Asks for the orbit of a system.
/// @param seconds of the processor after which it is stopped
Answer call(const System& system, double tolerance, double seconds);

}  // namespace hostile
