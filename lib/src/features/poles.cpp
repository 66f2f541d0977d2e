#include "src/features/poles.hpp"

#include "src/autodiff/reverse.hpp"
#include "src/features/divisors.hpp"
#include "src/features/separable.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace avi::detail {

int Poles::Pole::steepness() const {
  // Steeper ones gain nothing: the steps that they save elsewhere are the ones that take the most sweeps.
  return static_cast<int>(std::min(std::round(-power * degree), 6.0));
}

Poles::Poles(const ExpressionGraph& graph, int energy)
    : graph_(&graph), energy_(energy), on_(dependences(graph, energy)) {
  const std::vector<int> nodes = divisors(graph, energy, on_, most);
  if (nodes.empty()) return;
  const std::vector<double> degrees = degrees_of(graph, energy);
  for (const int node : nodes)
    poles_.push_back({node, degrees[static_cast<std::size_t>(node)], 0.0});
  for (Pole& pole : poles_)
    pole.power = power_in(graph, energy, pole.node);
  std::erase_if(poles_, [this](const Pole& pole) {
    if (pole.power < 0.0) return false;
    others_.push_back(pole);
    return true;
  });
  if (poles_.size() > most) poles_.clear();
}

double Poles::change(int node, double degree, const std::vector<double>& at) const {
  constexpr double part = 0x1p-20;
  std::vector<double> moved(at.begin(), at.begin() + std::max(node + 1, graph_->inputs()));
  moved[node] *= 1.0 + part;
  return degree * std::abs(evaluate(*graph_, energy_, moved) - at[energy_]) / part;
}

std::vector<Poles::Light> Poles::unfelt(const Sketch& sketch, double felt) const {
  std::vector<Light> light;
  if (sketch.samples.empty()) return light;
  for (const Pole& pole : poles_)
    light.push_back({pole.node, pole.degree, 0.0, pole.steepness(), 0.0});
  for (const Pole& other : others_)
    light.push_back({other.node, other.degree, 0.0, static_cast<int>(other.degree), 0.0});
  std::vector<double> at;
  const std::size_t every = sketch.samples.size() / 2 + 1;
  for (std::size_t i = 0; i < sketch.samples.size(); i += every) {
    at.assign(sketch.samples[i].z.begin(), sketch.samples[i].z.end());
    evaluate(*graph_, energy_, at);
    std::erase_if(light, [&](Light& each) {
      const double here = change(each.node, each.degree, at), s = std::sqrt(each.square(at[each.node]));
      each.strength = std::max(each.strength, here * std::pow(s, each.steepness));
      each.reach = std::max(each.reach, 0.5 * s);
      return each.degree < 2.0 || !(here < felt);
    });
  }
  return light;
}

std::vector<double> Poles::constants(const Sketch& sketch, const VectorX& metric, Eigen::Index seen) const {
  std::vector<double> constants(2 * poles_.size(), 0.0);
  ExpressionGraph graph = *graph_;
  std::vector<int> slopes;  // nodes of the sum of (H_pp)_ii (du/dq_i)^2
  for (const Pole& pole : poles_) {
    const std::vector<int> slope = Reverse(graph).gradient(pole.node);
    int sum = graph.constant(0.0);
    for (Eigen::Index i = 0; i < seen; ++i) {
      const int square = graph.binary(Operation::multiply, slope[i], slope[i]);
      sum = graph.binary(Operation::add, sum,
                         graph.binary(Operation::multiply, graph.constant(metric[i]), square));
    }
    slopes.push_back(sum);
  }
  const std::size_t every = sketch.samples.size() / 6 + 1;
  std::vector<double> at;
  for (std::size_t i = 0; i < sketch.samples.size(); i += every) {
    const Sketch::Sample& sample = sketch.samples[i];
    at.assign(sample.z.begin(), sample.z.end());
    evaluate(graph, graph.size() - 1, at);
    for (std::size_t k = 0; k < poles_.size(); ++k) {
      const Pole& pole = poles_[k];
      const double u = at[pole.node], change = this->change(pole.node, pole.degree, at);
      const int a = pole.steepness();
      const double frequency = std::sqrt(change * (1.0 + a) * at[slopes[k]]) / (pole.degree * std::abs(u));
      const double s = std::pow(std::abs(u), 1.0 / pole.degree), root = std::pow(s, 0.5 * a);
      if (!std::isfinite(frequency * s * root)) continue;
      constants[2 * k] = std::max(constants[2 * k], frequency * s * root);
      constants[2 * k + 1] = std::max(constants[2 * k + 1], change * root * root);
    }
  }
  return constants;
}

int Poles::rate(ExpressionGraph& graph, const Factor& energy_at_start, const std::vector<double>& constants,
                const Factor& beside) const {
  Factor frequency = beside, slope = 0.0, change = constants[1];
  const auto add = [](Factor& sum, const Factor& part) { sum = sum.number == 0.0 ? part : sum + part; };
  for (std::size_t k = 0; k < poles_.size(); ++k) {
    const double w = constants[2 * k + 2], e = constants[2 * k + 3];
    if (!(w > 0.0)) continue;
    const Pole& pole = poles_[k];
    const Factor near = length_from({graph, pole.node}, pole.degree).reciprocal();
    Factor whole = 1.0;  // s^-a
    const int a = pole.steepness();
    for (int i = 0; i < a; ++i)
      whole = whole * near;
    Factor rate = w * near;
    for (int i = 0; i < a / 2; ++i)
      rate = rate * near;
    if (a % 2 == 1) rate = rate * sqrt(near);
    add(frequency, rate);
    add(slope, (0.5 + 0.25 * a) * rate);
    change = change + e * whole;
  }
  if (frequency.node < 0) return graph.constant(1.0);
  const bool free = constants.front() > 0.0;
  const Factor near = free ? sqrt(frequency) : 1.0, root = std::sqrt(constants.front()) + near;
  if (slope.number == 0.0) return (free ? root * root : frequency).in(graph);
  const Factor error = Factor(graph, energy_) - energy_at_start;
  if (!free) return (frequency + error * (slope / change)).in(graph);
  return (root * root + error * (slope * root / (near * change))).in(graph);
}

}  // namespace avi::detail
