#pragma once
#include "avi/solve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

/// @file
/// The cost of a call of solve() so far, and the callback that reports its progress.

namespace avi::detail {

/// Seconds and sweeps of a call, its bounds on them, and its callback.
class Budget {
 public:
  /// Starts the clock of a call. @param options must outlive this
  explicit Budget(const SolveOptions& options) : options_(options) {}

  SolvePhase phase = SolvePhase::choosing;  ///< Phase of the call, for the callback.
  double start = 0.0, end = 1.0;            ///< Times at the ends of the run under way.
  double share = 1.0;                       ///< Part of the bounds that may be spent for now.
  long sweeps = 0;                          ///< Sweeps of the runs for this choice.
  long earlier = 0;                         ///< Sweeps of other choices, and of runs with them.

  /// Returns true if a bound was met since the last call of this function, or the callback has ended the
  /// call.
  bool was_met() { return std::exchange(met_, false) || cancelled_; }
  /// Returns true if the callback has asked for the end of the call.
  [[nodiscard]] bool cancelled() const { return cancelled_; }
  /// Seconds since the call began.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - began_).count();
  }
  /// The outcome with which the call ends now, with the run under way at this point; ok if it may go on.
  Outcome met(double t, long steps, long evaluations) {
    const Outcome outcome = found(t, steps, evaluations);
    if (outcome != Outcome::ok) met_ = true;
    return outcome;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Outcome found(double t, long steps, long evaluations) {
    if (cancelled_) return Outcome::stopped;
    if (static_cast<double>(earlier + sweeps + evaluations) >= share * static_cast<double>(options_.sweeps) ||
        steps >= options_.steps)
      return Outcome::step_limit;
    if (!options_.progress && !std::isfinite(options_.seconds)) return Outcome::ok;
    if (phase == told_ && ++waited_ < stride_) return Outcome::ok;
    const double now = seconds();
    stride_ = now - looked_ < 2e-4 ? std::min(2 * stride_, 64) : 1;
    waited_ = 0;
    looked_ = now;
    if (now >= share * options_.seconds) return Outcome::time_limit;
    const bool told = std::exchange(told_, phase) == phase;
    if (!options_.progress || (now < next_ && told)) return Outcome::ok;
    next_ = now + 0.05;
    const double fraction = std::clamp(std::abs(t - start) / std::abs(end - start), 0.0, 1.0);
    cancelled_ = !options_.progress({phase, t, fraction, steps, earlier + sweeps + evaluations, now});
    return cancelled_ ? Outcome::stopped : Outcome::ok;
  }
  const SolveOptions& options_;
  Clock::time_point began_ = Clock::now();
  double next_ = 0.0;  // time at which the callback is due
  SolvePhase told_ = SolvePhase::choosing;
  // Reading the clock costs a good part of a short step, so after short steps it is not read each time.
  double looked_ = 0.0;
  int stride_ = 1, waited_ = 0;
  bool cancelled_ = false, met_ = false;
};

}  // namespace avi::detail
