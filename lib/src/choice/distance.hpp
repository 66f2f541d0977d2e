#pragma once
#include "src/choice/journey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

/// @file
/// The distance of two states of an orbit, in the scale of every degree of freedom.

namespace avi::detail {

/// The distance of two states: the largest difference of an entry of (q, p), relative to the range through
/// which it moves. Motion by rounding alone does not count.
class Distance {
 public:
  /// Takes the diagonal of H_pp, which makes momenta and positions of different entries comparable.
  /// @param seen number of first coordinates and momenta that count
  Distance(VectorX metric, double tolerance, Eigen::Index seen)
      : metric_(std::move(metric)), seen_(seen),
        still_(std::max(1e-8, 30.0 * std::numeric_limits<double>::epsilon() / tolerance)),
        alike_(alike(metric_, seen)) {}

  double frequency = 0.0;  ///< Mean frequency over the sketch.
  VectorX noise;           ///< How far rounding may move each entry of (q, p); empty where it is not known.

  /// Distance of two states.
  double operator()(const State<dynamic>& a, const State<dynamic>& b, const Ranges& ranges) const {
    return speed((VectorX(2 * a.q.size()) << a.q - b.q, a.p - b.p).finished(), scales(ranges));
  }
  /// Size of a velocity in phase space, per unit of time.
  double operator()(const VectorX& velocity, const Ranges& ranges) const {
    return speed(velocity, scales(ranges));
  }
  /// Size of a velocity, with scales() found before.
  template <class Velocity>
  double speed(const Velocity& velocity, const VectorX& scale) const {
    double most = 0.0;
    const Eigen::Index n = metric_.size();
    for (Eigen::Index i = 0; i < seen_; ++i)
      most = std::max({most, part(velocity[i], scale[i]), part(velocity[n + i], scale[n + i])});
    return most;
  }

  /// The largest rounding error of an entry, relative to its range.
  [[nodiscard]] double rounding_of(const State<dynamic>& z, const Ranges& ranges) const {
    return std::numeric_limits<double>::epsilon() * speed(stacked(z), scales(ranges));
  }
  /// The scales by which differences of entries are divided.
  [[nodiscard]] VectorX scales(const Ranges& ranges) const {
    const Eigen::Index n = metric_.size();
    VectorX scale = ranges.high - ranges.low;
    // The largest motion of all, in units of the kinetic energy. A range of 1e-14 of it is rounding, unless
    // rounding is known to move the entry by less than that, as with a body without mass.
    double of_q = 0.0, of_p = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      of_q = std::max(of_q, scale[i] / std::sqrt(metric_[i]));
      of_p = std::max(of_p, scale[n + i] * std::sqrt(metric_[i]));
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const double root = std::sqrt(metric_[i]);
      // What moves by rounding alone is at rest, and its scale is its position.
      const double place = std::max(std::abs(ranges.high[i]), std::abs(ranges.low[i]));
      const bool rests = scale[i] <= few_digits * place && bound(of_q * root, i) <= 1e-12 * place;
      scale[i] = rests ? place : shown(scale[i], of_q * root, i);
      if (scale[n + i] <= few_digits * frequency * place / metric_[i])
        scale[n + i] = frequency * place / metric_[i];
      // The scale of a momentum that hardly changes depends on its size; else its rounding would exceed the
      // tolerance.
      const double size = std::max(std::abs(ranges.high[n + i]), std::abs(ranges.low[n + i]));
      scale[n + i] = std::max(shown(scale[n + i], of_p / root, n + i), still_ * size);
    }
    // The far end of a chain should not set the steps before a wave has come there.
    for (const std::vector<Eigen::Index>& entries : alike_)
      for (const Eigen::Index first : {Eigen::Index{0}, n}) {
        double most = 0.0;
        for (const Eigen::Index i : entries)
          most = std::max(most, ranges.high[first + i] - ranges.low[first + i]);
        for (const Eigen::Index i : entries) {
          // What rests by symmetry is moved by the rounding of the others.
          const bool rests = ranges.high[first + i] - ranges.low[first + i] <= 1e-11 * most;
          scale[first + i] = std::max(scale[first + i], (rests ? still_ : unnoticed) * most);
        }
      }
    return scale;
  }

 private:
  static constexpr double rounding = 1e-14;
  static constexpr double unnoticed = 1e-8;  // part of the largest range among similar entries
  static constexpr double few_digits = 8.0 * std::numeric_limits<double>::epsilon();
  static double part(double difference, double scale) {
    if (difference == 0.0) return 0.0;
    return std::isfinite(difference) ? std::abs(difference) / scale : infinity;
  }
  /// Groups of coordinates with about the same mass.
  static std::vector<std::vector<Eigen::Index>> alike(const VectorX& metric, Eigen::Index seen) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(seen));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index i, Eigen::Index j) { return metric[i] < metric[j]; });
    std::vector<std::vector<Eigen::Index>> groups;
    for (const Eigen::Index i : order) {
      if (groups.empty() || metric[i] > 2.0 * metric[groups.back().back()]) groups.emplace_back();
      groups.back().push_back(i);
    }
    return groups;
  }
  /// The largest range of an entry that may be rounding, if the largest motion of all is `most`.
  [[nodiscard]] double bound(double most, Eigen::Index i) const {
    return noise.size() > 0 ? std::min(rounding * most, noise[i]) : rounding * most;
  }
  /// The scale of an entry with this range. If only rounding moves the entry, as at the node of a vibration,
  /// the scale is that of the largest motion.
  [[nodiscard]] double shown(double range, double most, Eigen::Index i) const {
    const double least = bound(most, i);
    return noise.size() > 0 && range <= least ? most : std::max(range, least);
  }
  VectorX metric_;
  Eigen::Index seen_;
  // Part of its size by which a momentum has to move, and part of the largest range among similar entries
  // that is the least scale of one at rest. With less, rounding would exceed the tolerance.
  double still_;
  std::vector<std::vector<Eigen::Index>> alike_;
};

}  // namespace avi::detail
