#include "src/choice/measured.hpp"

#include "avi/autodiff/recording.hpp"

namespace avi::detail {

VectorX strengths(const Sketch& sketch, const VectorX& metric) {
  const Eigen::Index n = metric.size();
  VectorX strength = VectorX::Zero(2 * n);
  for (const Sketch::Sample& sample : sketch.samples)
    for (Eigen::Index i = 0; i < n; ++i) {
      strength[i] = std::max(strength[i], std::abs(sample.slope[n + i]));
      strength[n + i] = std::max(strength[n + i], std::abs(sample.slope[i]));
    }
  double forces = 0.0, speeds = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    forces = std::max(forces, strength[i] * std::sqrt(metric[i]));
    speeds = std::max(speeds, strength[n + i] / std::sqrt(metric[i]));
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    strength[i] = std::max(strength[i], 1e-14 * forces / std::sqrt(metric[i]));
    strength[n + i] = std::max(strength[n + i], 1e-14 * speeds * std::sqrt(metric[i]));
  }
  return strength;
}

Measured measure(const Sketch& sketch, const Resting& resting, double energy_at_start, double kinetic,
                 const VectorX& strength) {
  Measured measured;
  measured.lively.reserve(sketch.samples.size());
  const Eigen::Index n = strength.size() / 2;
  for (std::size_t k = 0; k < sketch.samples.size(); ++k) {
    const Sketch::Sample& sample = sketch.samples[k];
    measured.lively.push_back(kinetic + 0.5 * (sample.energy + energy_at_start) - resting.energy[k]);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double at_rest = resting.forces[k * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)];
      measured.add_slope(at_rest - 0.5 * sample.slope[n + i], strength[i]);
      measured.add_slope(0.5 * sample.slope[i], strength[n + i]);
    }
  }
  return measured;
}

Measured measure(const Sketch& sketch, const ExpressionGraph& graph, int node, const VectorX& strength,
                 bool with_changes) {
  Measured measured;
  RecordedFormula<double> formula{Recording(graph, node).value_and_gradient()};
  const auto at = [&](const auto& z) {
    formula.run(z.data(), z.data() + z.size() / 2, z.size() / 2);
    return formula.value();
  };
  const auto along = [&](const auto& slope) {
    double change = 0.0;
    for (Eigen::Index i = 0; i < slope.size(); ++i)
      change += formula.partial(static_cast<int>(i)) * slope[i];
    return std::abs(change);
  };
  const Eigen::Index size = strength.size();
  VectorX middle, slope, low = VectorX::Constant(size, infinity), high = -low, shaken = VectorX::Zero(size);
  for (std::size_t k = 0; k < sketch.samples.size(); ++k) {
    const Sketch::Sample& sample = sketch.samples[k];
    measured.lively.push_back(at(sample.z));
    for (int i = 0; i < static_cast<int>(size); ++i)
      measured.add_slope(formula.partial(i), strength[i]);
    if (!with_changes) continue;
    for (int i = 0; i < static_cast<int>(size); ++i)
      shaken[i] += sample.h * std::abs(formula.partial(i) / measured.lively.back());
    low = low.cwiseMin(sample.z), high = high.cwiseMax(sample.z);
    measured.changes.push_back({measured.lively.back(), along(sample.slope)});
    if (sample.last || k + 1 == sketch.samples.size()) continue;
    // Value and slope halfway along the cubic polynomial between the two samples.
    const Sketch::Sample& next = sketch.samples[k + 1];
    middle = 0.5 * (sample.z + next.z) + 0.125 * sample.h * (sample.slope - next.slope);
    slope = 1.5 / sample.h * (next.z - sample.z) - 0.25 * (sample.slope + next.slope);
    const double value = at(middle);
    measured.changes.push_back({value, along(slope)});
  }
  for (Eigen::Index i = 0; i < size; ++i)
    if (const Eigen::Index other = (i + size / 2) % size; with_changes && std::isfinite(strength[i]))
      measured.shaken = std::max(measured.shaken, shaken[i] / (high[other] - low[other]));
  return measured;
}

double with_constant(double near, double constant) {
  const double root = std::sqrt(near) + std::sqrt(constant);
  return root * root;
}

double fastest_change(const Measured& near, double constant) {
  double most = 0.0;
  for (const auto& [value, change] : near.changes) {
    const double rate = with_constant(value, constant);
    most = std::max(most, change / (rate * std::sqrt(value * rate)));
  }
  return most;
}

double background(const Sketch& sketch, const Measured& near) {
  double mean = 0.0, best = 0.0, least = infinity;
  for (std::size_t k = 0; k < near.lively.size(); ++k)
    mean += sketch.samples[k].h * near.lively[k] / sketch.time;
  for (const double part : {0.0, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    double fictive = 0.0, longest = fastest_change(near, part * mean);
    for (std::size_t k = 0; k < near.lively.size(); ++k) {
      const double frequency = with_constant(near.lively[k], part * mean);
      fictive += sketch.samples[k].h * frequency;
      longest = std::max(longest, sketch.samples[k].frequency / frequency);
    }
    if (fictive * longest < least) least = fictive * longest, best = part * mean;
  }
  return best;
}

}  // namespace avi::detail
