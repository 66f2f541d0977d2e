#pragma once
#include "avi/solve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

/// @file
/// The cost of a call of solve() so far, and the callback that is told how far it has come.

namespace avi::detail {

/// Seconds and sweeps of a call, its bounds on them, and its callback.
class Budget {
 public:
  /// From now on. @param options outlive this
  explicit Budget(const SolveOptions& options) : options_(options) {}

  SolvePhase phase = SolvePhase::choosing;  ///< Phase of the call, for the callback.
  double start = 0.0, end = 1.0;            ///< Times between which the run under way goes.
  double share = 1.0;                       ///< Part of the bounds that may be spent for now.
  long sweeps = 0;                          ///< Spent by the runs of this choice before it.
  long earlier = 0;                         ///< Spent by other choices and on runs with them.

  /// A bound was met since this was last called, or the callback has ended the call.
  bool was_met() { return std::exchange(met_, false) || cancelled_; }
  /// The callback has said that the call is to end.
  [[nodiscard]] bool cancelled() const { return cancelled_; }
  /// Since the call began.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - began_).count();
  }
  /// The outcome that ends the call where the run under way has come so far, or ok.
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
  double next_ = 0.0;  // when the callback is due
  SolvePhase told_ = SolvePhase::choosing;
  // The clock costs a good part of a short step: where steps are short it is not looked at after each.
  double looked_ = 0.0;
  int stride_ = 1, waited_ = 0;
  bool cancelled_ = false, met_ = false;
};

}  // namespace avi::detail
