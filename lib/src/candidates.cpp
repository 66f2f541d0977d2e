#include "candidates.hpp"

#include <limits>
#include <numeric>

namespace avi::detail {

namespace {

/// A name in the menu, and the power of the Liveliness that it stands for.
struct Entry {
  const char* name;
  double alpha;
};
constexpr Entry entries[] = {{"fixed", 0.0}, {"energy", 1.0}, {"energy^1.5", 1.5}, {"acceleration", 0.375}};

/// H with all momenta put to zero but that of time, in the same graph.
int at_rest(ExpressionGraph& graph, int energy, bool timed) {
  const auto n = static_cast<std::size_t>(graph.inputs()) / 2;
  std::vector<int> arguments(n);
  std::iota(arguments.begin(), arguments.end(), 0);
  arguments.resize(2 * n, graph.constant(0.0));
  if (timed) arguments.back() = graph.inputs() - 1;
  return graph.substitute(graph, energy, arguments);
}

/// The node of the Liveliness.
int liveliness_of(ExpressionGraph& graph, int energy, double energy_at_start, double kinetic, bool timed) {
  const int half = graph.binary(Operation::multiply, graph.constant(0.5), energy);
  const int moving = graph.binary(Operation::subtract, half, at_rest(graph, energy, timed));
  return graph.binary(Operation::add, moving, graph.constant(0.5 * energy_at_start + kinetic));
}

/// The largest derivative of H by each entry on the way; what is 1e-14 of the others, masses taken out, is
/// rounding.
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

/// The node of \f$1 + \sum_i (w_i\, \partial H/\partial q_i)^2\f$.
int accelerating(ExpressionGraph& graph, int energy, const std::vector<double>& weights) {
  const std::vector<int> slope = Reverse(graph).gradient(energy);
  int sum = graph.constant(1.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const int a = graph.binary(Operation::multiply, graph.constant(weights[i]), slope[i]);
    sum = graph.binary(Operation::add, sum, graph.binary(Operation::multiply, a, a));
  }
  return sum;
}

/// The power 3/8 of the sum of squares: see Choice::accelerations.
Candidate accelerated(const std::shared_ptr<ExpressionGraph>& graph, int energy, double energy_at_start,
                      const Choice& constants) {
  const int lively = accelerating(*graph, energy, constants.accelerations);
  return {"acceleration", 0.375, graph, energy, energy_at_start, std::make_shared<Liveliness>(*graph, lively),
          lively};
}

}  // namespace

std::vector<double> accelerations(const Sketch& sketch, const VectorX& metric, Eigen::Index seen) {
  std::vector<double> weights(static_cast<std::size_t>(seen), 0.0);
  if (sketch.samples.empty()) return weights;
  VectorX low = sketch.samples.front().z, high = low;
  for (const Sketch::Sample& sample : sketch.samples)
    low = low.cwiseMin(sample.z), high = high.cwiseMax(sample.z);
  double root = 0.0;  // mean of the square roots: what is large for a short time counts little
  for (Eigen::Index i = 0; i < seen; ++i)
    if (high[i] > low[i]) weights[static_cast<std::size_t>(i)] = metric[i] / (high[i] - low[i]);
  const Eigen::Map<const VectorX> weight(weights.data(), seen);
  for (const Sketch::Sample& sample : sketch.samples)
    root += sample.h / sketch.time *
            std::sqrt(weight.cwiseProduct(sample.slope.segment(metric.size(), seen)).norm());
  for (double& each : weights)
    each /= root * root > 0.0 ? root * root : 1.0;
  return weights;
}

std::string names_of_monitors() {
  std::string names;
  for (const Entry& entry : entries)
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return names;
}

bool is_monitor(std::string_view name) {
  return std::ranges::any_of(entries, [&](const Entry& entry) { return name == entry.name; });
}

Candidate candidate(std::string_view name, const ExpressionGraph& formula, int energy, double energy_at_start,
                    const Choice& constants, bool timed, int given) {
  const auto graph = std::make_shared<ExpressionGraph>(formula);
  if (given >= 0)
    return {"given", -1.0, graph, energy, energy_at_start, std::make_shared<Liveliness>(*graph, given),
            given};
  const Entry& entry = *std::ranges::find_if(entries, [&](const Entry& it) { return name == it.name; });
  if (entry.alpha == 0.0) return {entry.name, 0.0, graph, energy, energy_at_start, nullptr, -1};
  if (name == "acceleration") return accelerated(graph, energy, energy_at_start, constants);
  const int lively = liveliness_of(*graph, energy, energy_at_start, constants.kinetic, timed);
  return {entry.name, entry.alpha,     graph,
          energy,     energy_at_start, std::make_shared<Liveliness>(*graph, lively),
          lively};
}

std::vector<Candidate> candidates(const ExpressionGraph& formula, int energy, double energy_at_start,
                                  const Sketch& sketch, const VectorX& metric, const Choice& constants,
                                  bool timed, int given) {
  const double kinetic = constants.kinetic;
  const auto graph = std::make_shared<ExpressionGraph>(formula);
  const double size = 1.6 * energy, overhead = Candidate::overhead(graph->inputs());
  std::vector<Candidate> menu;
  std::vector<double> work;
  menu.emplace_back("fixed", 0.0, graph, energy, energy_at_start, nullptr, -1);
  work.push_back(size + overhead);
  if (kinetic > 0.0 && sketch.samples.size() > 1) {
    const int lively = liveliness_of(*graph, energy, energy_at_start, kinetic, timed);
    const auto liveliness = std::make_shared<Liveliness>(*graph, lively);
    for (const auto& [name, alpha] : entries) {
      if (alpha < 1.0) continue;
      menu.emplace_back(name, alpha, graph, energy, energy_at_start, liveliness, lively);
      work.push_back(1.7 * size + 16.0 + overhead);
    }
  }
  if (given >= 0) {
    menu.push_back(candidate("given", *graph, energy, energy_at_start, constants, timed, given));
    work.push_back(1.7 * size + 16.0 + overhead);
  }
  const VectorX strength = strengths(sketch, metric);
  const double rounding =
      std::numeric_limits<double>::epsilon() * std::max(std::abs(energy_at_start), std::abs(kinetic));
  const auto look = [&](Candidate& it, double cost) {
    double least = infinity, most = 0.0;
    for (const Sketch::Sample& sample : sketch.samples) {
      const double g = it.rate(sample.z.data());
      it.fictive += sample.h / g;
      it.longest = std::max(it.longest, g * sample.frequency);
      least = g > 0.0 && std::isfinite(g) ? std::min(least, g) : 0.0;
      most = std::max(most, g);
      if (least == 0.0) break;
      if (!it.fixed())
        for (int i = 0; i < static_cast<int>(strength.size()); ++i)
          it.noise = std::max(it.noise, rounding * std::abs(it.slope(i)) / (g * strength[i]));
    }
    it.outlook = cost * it.fictive * it.longest;
    const bool idle = !it.fixed() && given < 0 && !(most > 1.15 * least);
    if (!(least > 0.0) || !std::isfinite(it.outlook) || idle) it.outlook = infinity;
    if (it.fixed() && sketch.samples.empty()) it.outlook = 1.0, it.fictive = 1.0;
  };
  for (std::size_t k = 0; k < menu.size(); ++k)
    look(menu[k], work[k]);
  // Where the fastest part of the motion makes all steps many times shorter than the others need be, as when
  // two of many bodies meet.
  double steps = infinity;
  for (const Candidate& it : menu)
    if (std::isfinite(it.outlook)) steps = std::min(steps, it.fictive * it.longest);
  if (sketch.samples.size() > 1 && steps > 5.0 * sketch.radians) {
    menu.push_back(accelerated(graph, energy, energy_at_start, constants));
    look(menu.back(), 4.0 * size + 16.0 + overhead);
  }
  std::erase_if(menu, [](const Candidate& it) { return !it.fixed() && !std::isfinite(it.outlook); });
  std::ranges::stable_sort(menu, {}, &Candidate::outlook);
  return menu;
}

}  // namespace avi::detail
