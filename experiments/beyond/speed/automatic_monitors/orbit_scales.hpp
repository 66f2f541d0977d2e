#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/integrators/runge_kutta.hpp"
#include "beyond/speed/automatic_monitors/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

/// @file
/// The scales of time, speed and energy of an orbit, by a short, rough run along it.

namespace experiment {

using avi::ExpressionGraph, avi::VectorX, avi::Formula, avi::Recording, avi::Program, avi::RungeKuttaStages,
    avi::ClassicalRungeKutta;

/// Means in time along the first part of an orbit: at most 64 Runge-Kutta steps of three tenths of the local
/// time scale. The constants of a monitor come from here; it then is a fixed function.
class OrbitScales {
 public:
  /// @param curvature of this orbit's H, with a metric
  OrbitScales(const Orbit& orbit, Curvature& curvature)
      : n0(curvature.squared_frequency_squared()), size_(orbit.start.q.size()), curved_(curvature.graph, n0),
        slopes_(Recording(orbit.energy.graph(), orbit.energy.node()).value_and_gradient()), room_(slopes_) {
    VectorX z(2 * size_);
    for (Eigen::Index i = 0; i < size_; ++i)
      z[i] = orbit.start.q[i], z[size_ + i] = orbit.start.p[i];
    run(curvature, z);
    find_turns(curvature);
  }

  int n0;                      ///< Node of \f$n_0\f$, see Curvature.
  double frequency = 0.0;      ///< Mean of \f$n_0^{1/4}\f$.
  double squared_speed = 0.0;  ///< Mean of the first squared speed plus the second over frequency squared.
  double kinetic = 0.0;        ///< Half the mean of the first one.
  double time = 0.0;           ///< Physical length of the run.
  long evaluations = 0;        ///< Of the vector field.

  /// The fictive time \f$\int dt/g\f$ of the first `span` of the orbit; beyond the run, carried on from it.
  [[nodiscard]] double fictive_time(const Formula& monitor, double span) const {
    double sum = 0.0, passed = 0.0;
    for (const Sample& sample : samples_) {
      if (passed >= span) break;
      sum += sample.h / value(monitor, sample.z);
      passed += sample.h;
    }
    return sum * (span / passed);
  }
  /// The time in which \f$\int\omega\,dt\f$ reaches `angle`, or the angle by which the velocity in phase
  /// space has turned, if that is sooner (a closed curve turns by 2 pi at least: Fenchel 1929). Beyond the
  /// run as it was on it.
  [[nodiscard]] double time_of(double angle) const {
    double passed = 0.0, turned = 0.0, left = angle;
    for (const Sample& sample : samples_) {
      turned += sample.turn;
      if (turned >= angle) return passed;
      if (sample.h * sample.frequency >= left) return passed + left / sample.frequency;
      left -= sample.h * sample.frequency;
      passed += sample.h;
    }
    return turned > angle - left ? passed * (angle / turned) : passed + left / frequency;
  }
  /// The values of a monitor along the orbit.
  struct MonitorRange {
    double low = std::numeric_limits<double>::infinity();  ///< Smallest value on the way.
    double high = 0.0;                                     ///< Largest; not a number where one is not finite.
    /// \f$\int dt/g \cdot \max(g\omega) / \int\omega\,dt\f$ with \f$\omega = n_0^{1/4}\f$: estimated steps
    /// relative to those of the ideal monitor g = 1/omega, if max(g omega) limits h. At least 1.
    double unevenness = 1.0;
  };
  /// The range of a monitor along the orbit.
  [[nodiscard]] MonitorRange range(const Formula& monitor) const {
    MonitorRange range;
    double fictive = 0.0, longest = 0.0;
    for (const Sample& sample : samples_) {
      const double g = value(monitor, sample.z);
      range.low = std::min(range.low, g);
      range.high = std::isfinite(g) ? std::max(range.high, g) : std::numeric_limits<double>::quiet_NaN();
      fictive += sample.h / g;
      longest = std::max(longest, g * sample.frequency);
    }
    range.unevenness = fictive * longest / (frequency * time);
    return range;
  }

 private:
  [[nodiscard]] double value(const Formula& f, const VectorX& z) const { return f.value(z); }
  /// dz = the field at z; returns H.
  double field(const VectorX& z, VectorX& dz) {
    std::copy(z.data(), z.data() + z.size(), room_.arguments());
    slopes_.run(room_);
    const int n = static_cast<int>(size_);
    for (int i = 0; i < n; ++i) {
      dz[i] = slopes_.slope(room_, n + i);
      dz[n + i] = -slopes_.slope(room_, i);
    }
    ++evaluations;
    return slopes_.value(room_);
  }

  void run(const Curvature& curvature, VectorX z) {
    RungeKuttaStages<ClassicalRungeKutta> step(2 * size_);
    VectorX next(2 * size_);
    double energy = field(z, step.k[0]), positions = 0.0, momenta = 0.0, angle = 0.0, longest = 1e300,
           liveliest = 0.0;
    double scale = first_frequency(z, step.k[0]);
    if (!(scale > 0.0)) return;
    for (int i = 0; i < 64; ++i) {
      const double local = std::pow(value(curved_, z), 0.25);
      const auto [fast, pushed] = curvature.squared_speeds(step.k[0]);
      const double h = std::min(longest, 0.3 / std::max(local, scale / 8.0));
      step.advance([this](const VectorX& x, VectorX& dx) { field(x, dx); }, z, h);
      const double energy_there = field(step.end, next);
      liveliest = std::max(liveliest, 0.5 * fast);
      const double lively_there = 0.5 * curvature.squared_speeds(next).first;
      if (!std::isfinite(lively_there) ||
          !(std::abs(energy_there - energy) <= 1e-3 * std::max(liveliest, lively_there))) {
        longest = 0.5 * h;  // too long: H changes steeply here
        if (h < 1e-9 * time || h == 0.0) break;
        continue;
      }
      if (!std::isfinite(local + fast + pushed)) break;
      longest = 2.0 * h;
      samples_.push_back({.z = z, .h = h, .frequency = local});
      time += h;
      angle += h * local;
      positions += h * fast;
      momenta += h * pushed;
      scale = std::max(angle / time, 1e-3 * scale);
      z = step.end;
      step.k[0] = next;
      energy = energy_there;
    }
    if (!(angle > 0.0)) return;
    frequency = angle / time;
    kinetic = 0.5 * positions / time;
    squared_speed = (positions + momenta / (frequency * frequency)) / time;
  }

  /// n_0^(1/4) at the start; where it vanishes there, one over the time in which the straight line of the
  /// first velocity meets a curvature of that scale.
  [[nodiscard]] double first_frequency(const VectorX& z, const VectorX& dz) const {
    const double here = std::pow(value(curved_, z), 0.25);
    if (here > 0.0 || !std::isfinite(here)) return std::isfinite(here) ? here : 0.0;
    for (double s = 0x1p-30; s < 0x1p30; s *= 2.0) {
      VectorX ahead = z;
      for (Eigen::Index i = 0; i < z.size(); ++i)
        ahead[i] += s * dz[i];
      const double there = std::pow(value(curved_, ahead), 0.25);
      if (std::isfinite(there) && there * s > 0.1) return there;
    }
    return 0.0;
  }

  void find_turns(const Curvature& curvature) {
    for (std::size_t i = 1; i + 1 < samples_.size(); ++i)
      samples_[i].turn =
          curvature.angle(samples_[i].z - samples_[i - 1].z, samples_[i + 1].z - samples_[i].z, frequency);
  }

  struct Sample {
    VectorX z;
    double h, frequency;
    double turn = 0.0;  // of the chord that ends here into the next one
  };

  Eigen::Index size_;
  std::vector<Sample> samples_;
  Formula curved_;
  Program slopes_;
  Program::Room<double> room_;
};

/// The node of automatic_monitor() in the graph of the curvature.
/// @throws std::invalid_argument where the orbit has no time scale
inline int curvature_monitor(Curvature& curvature, const OrbitScales& scales) {
  if (!(scales.frequency > 0.0))
    throw std::invalid_argument(
        "The second derivatives of H with respect to q are zero or not finite along the orbit, so "
        "that it has no time scale; give a monitor of your own, or none.");
  ExpressionGraph& graph = curvature.graph;
  const auto plus = [&](int a, double b) { return curvature.plus(a, graph.constant(b)); };
  const double low = scales.frequency / 8.0;
  const int smooth = plus(scales.n0, std::pow(0.0625 * scales.frequency, 4));
  return graph.power(plus(graph.power(smooth, 0.5), low * low), -0.5);
}

}  // namespace experiment
