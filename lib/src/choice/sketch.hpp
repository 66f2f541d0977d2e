#pragma once
#include "src/choice/point_field.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

/// @file
/// A rough run along the beginning of an orbit, from which its scales are taken.

namespace avi::detail {

/// Points along the beginning of an orbit, from a run by the Bogacki-Shampine pair. Its tolerance is loose,
/// and relative to the range through which each entry of (q, p) moves, so that the steps follow the fastest
/// entry, whatever its mass or unit. What is measured here sets lengths of trials and first guesses, never a
/// result.
class Sketch {
 public:
  /// A point of the sketch and the step from it.
  struct Sample {
    using Numbers = Eigen::Map<const VectorX>;  ///< Vector of 2n numbers, which the sketch holds.
    Numbers z;                                  ///< The point (q, p).
    Numbers slope;                              ///< Velocity in phase space.
    Numbers errors;                             ///< Errors of the step, for each entry.
    double h;                                   ///< Time to the next sample.
    double frequency;   ///< Radians per unit of time, estimated from the error of the step.
    double energy;      ///< Value of H.
    bool last = false;  ///< Whether the next sample, if any, is not at the end of this step.
  };

  static constexpr int few = 128;  ///< Largest number of steps, unless more are asked for.

  /// Makes a sketch along the orbit of `field` from z, over the time `span` or at most `most` steps.
  /// @param metric diagonal of H_pp; a motion of 1e-10 of the largest, masses taken out, does not limit the
  /// steps @param before time that has passed already; if 0, the sketch ends where the orbit begins to repeat
  /// itself @param longest the longest step allowed
  Sketch(PointField& field, const VectorX& z, double span, const VectorX& metric, int most = few,
         double before = 0.0, double longest = infinity);

  std::vector<Sample> samples;  ///< Samples in the order of time.
  double time = 0.0;            ///< Length in time.
  double radians = 0.0;         ///< Integral of the frequency over time.
  bool stuck = false;           ///< Whether steps became too short to go on, as before a singularity.

  /// The time of the fastest motion, and the factor by which that is faster than the slowest.
  [[nodiscard]] std::pair<double, double> fastest() const {
    double t = 0.0, at = 0.0, most = 0.0, least = infinity;
    for (const Sample& sample : samples) {
      if (sample.frequency > most) at = t, most = sample.frequency;
      if (sample.frequency > 0.0) least = std::min(least, sample.frequency);
      t = sample.last ? resumed_ : t + sample.h;
    }
    return {at, most / least};
  }
  /// The highest frequency of a sample.
  [[nodiscard]] double highest_frequency() const {
    double most = 0.0;
    for (const Sample& sample : samples)
      most = std::max(most, sample.frequency);
    return most;
  }
  /// Adds the samples of another part of the orbit, which begins so long after the first one.
  void append(Sketch&& other, double later) {
    if (!samples.empty()) samples.back().last = true;
    resumed_ = later;
    for (const Sample& sample : other.samples)
      samples.push_back(sample);
    time += other.time, radians += other.radians;
    more_.push_back(std::move(other.numbers_));
  }
  /// The time in which the phase grows by so many radians, extrapolated beyond the end of the sketch.
  [[nodiscard]] double time_of(double phase) const {
    double t = 0.0, seen = 0.0;
    for (const Sample& sample : samples) {
      const double here = sample.h * sample.frequency;
      if (seen + here >= phase) return t + (phase - seen) / sample.frequency;
      seen += here;
      t += sample.h;
    }
    return seen > 0.0 ? t * phase / seen : infinity;
  }

 private:
  void find_frequencies(const VectorX& ranges, const VectorX& roots, bool timed, bool limited);

  double resumed_ = 0.0;                         // time at which the second part begins, if any
  std::unique_ptr<double[]> numbers_;            // numbers of all samples,
  std::vector<std::unique_ptr<double[]>> more_;  // and of those that were appended
};

}  // namespace avi::detail
