#include "candidates.hpp"

#include "orbit_scales.hpp"

#include <limits>
#include <numeric>

namespace avi::detail {

namespace {

/// What curvatures cost to build grows with the fourth power of the coordinates in a term.
constexpr double most_products = 1e5;

double products_of_curvature(const ExpressionGraph& graph, int energy) {
  const int n = graph.inputs() / 2;
  if (n > 30 || graph.size() > 4000) return std::numeric_limits<double>::infinity();
  ExpressionGraph copy = graph;
  double fourth = 0.0, momenta = 0.0;
  for (const Terms::Term& term : Terms::of(copy, energy)) {
    const std::vector<char> part = copy.parts(term.node);
    double count = 0.0, of_p = 0.0;
    for (int i = 0; i < 2 * n && i <= term.node; ++i) {
      count += part[static_cast<std::size_t>(i)];
      if (i >= n) of_p += part[static_cast<std::size_t>(i)];
    }
    fourth += count * count * count * count;
    momenta += of_p * of_p;
  }
  return std::max(fourth, momenta * momenta);
}

/// The nodes of the first `count` arguments.
std::vector<int> arguments(int count) {
  std::vector<int> nodes(static_cast<std::size_t>(count));
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

/// g of automatic_monitor() as a node of `graph`, where it has a meaning.
int curvature_monitor(ExpressionGraph& graph, int energy, const VectorX& start) {
  const Eigen::Index n = start.size() / 2;
  const Orbit orbit(Formula(graph, energy), {.q = start.head(n), .p = start.tail(n)});
  Curvature curvature(orbit);
  const OrbitScales scales(orbit, curvature);
  const int monitor = curvature_monitor(curvature, scales);
  return graph.substitute(curvature.graph, monitor, arguments(graph.inputs()));
}

}  // namespace

int at_rest(ExpressionGraph& graph, int energy) {
  const int n = graph.inputs() / 2;
  std::vector<int> at = arguments(n);
  at.resize(2 * static_cast<std::size_t>(n), graph.constant(0.0));
  return graph.substitute(graph, energy, at);
}

std::vector<Candidate> candidates(const ExpressionGraph& formula, int energy, double energy_at_start,
                                  const VectorX& start, const Sketch& sketch, const VectorX& metric,
                                  double kinetic) {
  const auto graph = std::make_shared<ExpressionGraph>(formula);
  const int zero = graph->binary(Operation::subtract, energy, graph->constant(energy_at_start));
  const auto times = [&](int g) { return graph->binary(Operation::multiply, g, zero); };
  std::vector<Candidate> menu;
  const double size = static_cast<double>(graph->parts(energy).size());
  menu.emplace_back("fixed", graph, energy, graph->constant(1.0));
  menu.back().work = size;
  if (kinetic > 0.0 && sketch.samples.size() > 1) {
    const int half = graph->binary(Operation::multiply, graph->constant(0.5), energy);
    const int moving = graph->binary(Operation::subtract, half, at_rest(*graph, energy));
    const int lively =
        graph->binary(Operation::add, moving, graph->constant(0.5 * energy_at_start + kinetic));
    for (const auto& [name, exponent] : {std::pair{"energy", -1.0}, {"energy^1.5", -1.5}}) {
      const int g = graph->power(lively, exponent);
      menu.emplace_back(name, graph, times(g), g);
      menu.back().work = 1.6 * size + 10.0;
    }
    if (products_of_curvature(*graph, energy) <= most_products) try {
        const int before = graph->size();
        const int g = curvature_monitor(*graph, energy, start);
        menu.emplace_back("curvature", graph, times(g), g);
        menu.back().work = size + 1.5 * (graph->size() - before);
      } catch (const std::invalid_argument&) {
        // H_pp is no metric there, or H has no curvature: the others have to do.
      }
  }
  // The largest derivative of H by each entry on the way; what is 1e-14 of the others, masses taken out, is
  // rounding.
  const Eigen::Index n = start.size() / 2;
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
  const double rounding =
      std::numeric_limits<double>::epsilon() * std::max(std::abs(energy_at_start), std::abs(kinetic));
  for (Candidate& it : menu) {
    double fictive = 0.0, longest = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (const Sketch::Sample& sample : sketch.samples) {
      const double g = it.rate(sample.z.data());
      fictive += sample.h / g;
      longest = std::max(longest, g * sample.frequency);
      least = g > 0.0 && std::isfinite(g) ? std::min(least, g) : 0.0;
      most = std::max(most, g);
      if (least == 0.0) break;
      if (!it.fixed())
        for (int i = 0; i < static_cast<int>(2 * n); ++i)
          it.noise = std::max(it.noise, rounding * std::abs(it.slope(i)) / (g * strength[i]));
    }
    it.fictive = fictive;
    it.outlook = it.work * fictive * longest;
    if (!(least > 0.0) || !std::isfinite(it.outlook) || (it.name != "fixed" && !(most > 1.15 * least)))
      it.outlook = std::numeric_limits<double>::infinity();
    if (it.name == "fixed" && sketch.samples.empty()) it.outlook = 1.0, it.fictive = 1.0;
  }
  std::erase_if(menu, [](const Candidate& it) { return it.name != "fixed" && !std::isfinite(it.outlook); });
  std::ranges::stable_sort(menu, {}, &Candidate::outlook);
  return menu;
}

}  // namespace avi::detail
