#pragma once
#include "avi/core/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

/// @file
/// The pauses of an orbit, in which it all but stops, and their lengths.

namespace avi::detail {

/// The pauses of a run: times in which everything changes ten times more slowly than before, as near a
/// saddle. The nearer an orbit comes to a saddle, the longer it stays, by the logarithm of the distance, so
/// that a small error decides when it leaves, and where to. A pause ends when the speed is three tenths of
/// the largest again.
class Pauses {
 public:
  /// The end of a pause. Speeds are relative to the largest before the pause.
  struct End {
    double t;        ///< Time of the end.
    double rate;     ///< Rate at which the speed grew at the end.
    double step;     ///< Length of the step, in time.
    double slowest;  ///< Lowest speed in the pause.
    double fastest;  ///< Highest speed after it.
    double length;   ///< Time since the lowest speed.
    double error;    ///< Energy error at the lowest speed, over its scale; 0 where rounding of H hides it.
    /// Returns true if the speed has grown exponentially, as it does from a saddle; in a fall it grows faster
    /// towards the end, and under a constant force more slowly.
    [[nodiscard]] bool is_at_saddle() const {
      return rate * length < 2.0 * std::log(1.0 / slowest) && rate * length > 0.5 * std::log(0.3 / slowest);
    }
    /// Returns true if another run, with other steps, should see this pause, too.
    [[nodiscard]] bool is_plain() const {
      return slowest < 0.02 && fastest > 0.6 && length > 2.5 * step && is_at_saddle();
    }
    /// Returns true if the energy that is left at a saddle, measured by the square of the speed, is less than
    /// its error, or than rounding. That error then decides on which side the orbit leaves, and when.
    [[nodiscard]] bool is_undecided() const {
      constexpr double rounding = 10.0 * std::numeric_limits<double>::epsilon();
      return is_at_saddle() && std::max(error, rounding) > 0.2 * slowest * slowest;
    }
    /// Mean time in which the speed grew by a factor e.
    [[nodiscard]] double time() const { return length / std::log(0.3 / slowest); }
    /// The change in the length of a pause at a saddle by an error of the energy, over its scale. The part of
    /// the energy that is left at the saddle is the square of the speed. But speeds are relative to the
    /// largest one, not to that of the energy scale, which makes the effect ten times smaller.
    [[nodiscard]] double lag(double its_error) const {
      return 0.05 * time() * its_error / (slowest * slowest);
    }
    /// The largest difference between the times at which two runs may see this pause.
    [[nodiscard]] double doubt() const { return std::max(time(), step); }
  };

  /// Begins with no pause. @param ranges those of the 2n entries of (q, p), as far as they are known before
  /// @param seen number of first coordinates and momenta that count
  explicit Pauses(VectorX ranges, Eigen::Index seen)
      : ranges_(std::move(ranges)), seen_(seen), largest_(VectorX::Zero(ranges_.size())) {}

  /// Takes in a step between two states. @param low,high ranges of the entries of (q, p) so far @param error
  /// energy error after it, 0 where rounding of H hides it @param slope called for the slope of (q, p) after
  /// it
  template <class Slope>
  void add(const State<dynamic>& before, const State<dynamic>& after, const VectorX& low, const VectorX& high,
           double error, Slope&& slope) {
    const Eigen::Index n = before.q.size();
    const double step = std::abs(after.t - before.t), middle = 0.5 * (before.t + after.t);
    double speed = 0.0, of_largest = 0.0;
    const auto look = [&](Eigen::Index i, double change) {
      const double range = std::max(high[i] - low[i], ranges_[i]);
      if (range > 0.0) speed = std::max(speed, std::abs(change) / range);
    };
    const auto compare = [&](Eigen::Index i, double change) {
      largest_[i] = std::max(largest_[i], std::abs(change) / step);
      if (largest_[i] > 0.0) of_largest = std::max(of_largest, std::abs(change) / step / largest_[i]);
    };
    for (Eigen::Index i = 0; i < seen_; ++i) {
      look(i, after.q[i] - before.q[i]), compare(i, after.q[i] - before.q[i]);
      look(n + i, after.p[i] - before.p[i]), compare(n + i, after.p[i] - before.p[i]);
    }
    speed /= step;
    // A motion that turns by a half in each step comes back to where it was, yet it is fast at both ends.
    if (const double chord = speed; fastest_ > 0.0 && chord < 0.1 * fastest_) {
      const VectorX& now = slope();
      for (Eigen::Index i = 0; i < seen_; ++i)
        look(i, now[i]), look(n + i, now[n + i]);
      const bool fast = speed >= 0.3 * fastest_;
      if (!fast || !was_fast_) speed = chord;
      was_fast_ = fast;
    } else {
      was_fast_ = true;
    }
    // The angle of a rotor takes on an ever larger range, of which it covers little between two kicks. At a
    // saddle, the one coordinate is slow in comparison with itself, too.
    if (seen_ == 1) speed = std::max(speed, of_largest * fastest_);
    const double part = fastest_ > 0.0 ? speed / fastest_ : 1.0;
    if (pauses_ && part > 0.3) {
      pauses_ = false;
      const double rate = std::log(speed / last_) / std::abs(middle - middle_);
      if (ends.size() < most && std::isfinite(rate)) {
        const double late = std::copysign(std::log(part / 0.3) / rate, after.t - before.t);
        ends.push_back({.t = middle - late,
                        .rate = rate,
                        .step = step,
                        .slowest = slowest_,
                        .fastest = part,
                        .length = std::abs(middle - since_),
                        .error = error_});
        undecided = undecided || ends.back().is_undecided();
      }
    }
    pauses_ = pauses_ || part < 0.1;
    if (!pauses_)
      slowest_ = 1.0;
    else if (part < slowest_)
      slowest_ = part, since_ = middle, error_ = error;
    if (!pauses_ && !ends.empty()) ends.back().fastest = std::max(ends.back().fastest, part);
    fastest_ = std::max(fastest_, speed);
    last_ = speed;
    middle_ = middle;
  }

  /// The time by which energy errors make pauses at saddles longer or shorter, if all act in the same sense.
  /// @param unseen an error that rounding of H may hide
  [[nodiscard]] double lag(double unseen) const {
    double sum = 0.0;
    for (const End& end : ends)
      if (end.is_at_saddle()) sum += end.lag(std::max(end.error, unseen));
    return sum;
  }

  std::vector<End> ends;   ///< Ends of the pauses, in order.
  bool undecided = false;  ///< Whether one of them was undecided, see End.

  static constexpr std::size_t most = 400;  ///< Largest number of ends that are kept.

 private:
  VectorX ranges_;
  Eigen::Index seen_;
  VectorX largest_;                                   // largest rates of the entries
  double fastest_ = 0.0, last_ = 0.0, middle_ = 0.0;  // speeds, relative to the ranges; time of the last one
  bool pauses_ = false, was_fast_ = true;
  double slowest_ = 1.0, since_ = 0.0, error_ = 0.0;  // lowest speed in the pause, its time and energy error
};

/// The difference of the times at which two runs along one orbit left their pauses, up to the time `until`,
/// in units of the time in which a distance grows by a factor e. It is infinite if one run saw a pause that
/// the other did not.
inline double parted_by(const Pauses& a, const Pauses& b, double start, double until) {
  double seen = std::abs(until - start), most = 0.0;
  for (const Pauses* run : {&a, &b})
    if (run->ends.size() == Pauses::most) seen = std::min(seen, std::abs(run->ends.back().t - start));
  const auto compare = [&](const Pauses& one, const Pauses& other) {
    for (const Pauses::End& end : one.ends) {
      if (!end.is_plain() || std::abs(end.t - start) + 2.0 * end.doubt() > seen) continue;
      double lag = std::numeric_limits<double>::infinity();
      for (const Pauses::End& its : other.ends)
        if (std::abs(its.t - end.t) <= std::max(end.doubt(), its.doubt()))
          lag = std::min(lag, std::abs(its.t - end.t) / std::max(end.time(), its.time()));
      most = std::max(most, lag);
    }
  };
  compare(a, b), compare(b, a);
  return most;
}

}  // namespace avi::detail
