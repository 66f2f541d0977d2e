#include "src/features/bends.hpp"

#include "src/core/lowest.hpp"
#include "src/features/divisors.hpp"
#include "src/features/separable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace avi::detail {

namespace {

/// Returns true for a quotient, a negative power or a logarithm, which are infinite at the zero of an
/// operand.
bool is_infinite_at_zero(const ExpressionGraph& graph, int node) {
  using enum Operation;
  const ExpressionGraph::Node& what = graph[node];
  return what.operation == divide || what.operation == log ||
         (what.operation == power && graph[what.b].number < 0.0);
}

/// Calls `take` for each factor of a node, unless that is marked in `seen`, and marks it.
template <class Take>
void for_factors(const ExpressionGraph& graph, int node, std::vector<char>& seen, const Take& take) {
  for (std::vector<int> open{node}; !open.empty();) {
    const int at = open.back();
    open.pop_back();
    if (std::exchange(seen[at], 1)) continue;
    switch (const ExpressionGraph::Node& it = graph[at]; it.operation) {
      using enum Operation;
    case multiply:
    case divide:
      open.push_back(it.b);
      [[fallthrough]];
    case power:
    case sqrt:
    case abs:
      open.push_back(it.a);
      break;
    default:
      take(at);
    }
  }
}

}  // namespace

Bends::Bends(const ExpressionGraph& graph, int energy, bool timed) : graph_(&graph) {
  find(energy, timed);
  if (size() > most) bends_.clear();
  if (none()) return;
  const std::vector<double> degrees = degrees_of(graph, energy);
  std::vector<int> nodes;
  for (Bend& bend : bends_) {
    bend.degree = degrees[static_cast<std::size_t>(bend.node)];
    bend.shortest = std::pow(bend.shortest, 1.0 / bend.degree);
    nodes.push_back(bend.node);
  }
  const std::vector<char> needed = graph.parts(nodes);
  for (std::size_t i = static_cast<std::size_t>(graph.inputs()); i < needed.size(); ++i)
    if (needed[i]) needed_.push_back(static_cast<int>(i));
  values_.resize(std::max(needed.size(), static_cast<std::size_t>(graph.inputs())));
  lengths_.resize(size()), speeds_.resize(size());
}

/// Finds the functions u.
void Bends::find(int energy, bool timed) {
  const ExpressionGraph& graph = *graph_;
  const std::vector<unsigned char> on = dependences(graph, energy);
  const std::vector<char> part = graph.parts(energy);
  const auto of_time = [&](int node) { return timed && on[node] == on_last; };
  // Nodes made of a function that turns, whose argument says where they bend; and constants.
  std::vector<char> settled(part.size(), 0);
  std::vector<int> singular;  // nodes that are singular at the zero of an operand
  const std::vector<double> least = lower_bounds(graph, energy);
  for (int i = 0; i <= energy && size() <= most; ++i) {
    const ExpressionGraph::Node& what = graph[i];
    if (what.operation == Operation::input) continue;
    const auto turned = [&](int node) { return node >= 0 && on[node] != 0 && settled[node]; };
    settled[i] = on[i] == 0 || turned(what.a) || turned(what.b);
    if (!part[i] || on[i] == 0) continue;
    if (is_infinite_at_zero(graph, i) || is_singular_at_zero(graph, i) || what.operation == Operation::cbrt)
      singular.push_back(i);
    // Its value is a length of degree 1 itself.
    if (what.operation == Operation::hypot && !settled[i] && least[i] > 0.0)
      bends_.push_back({i, 1.0, false, false, of_time(i), false, least[i]});
    if (!has(what.operation, shapes::turns)) continue;
    if (!settled[what.a] && std::ranges::find(bends_, what.a, &Bend::node) == bends_.end())
      bends_.push_back({what.a, 1.0, true, false, of_time(what.a), false, 1.0});
    settled[i] = 1;
  }
  if (singular.empty()) return;
  const auto operand = [&](int node) {
    return graph[node].operation == Operation::divide ? graph[node].b : graph[node].a;
  };
  // What may vanish on the way is no bend: H is singular there. Those of coordinates alone at whose zero H
  // would be infinite are poles, or narrow bumps.
  std::vector<char> poles(part.size(), 0), seen = settled;
  for (const int node : singular)
    if (is_infinite_at_zero(graph, node))
      for_factors(graph, operand(node), seen,
                  [&](int factor) { poles[factor] = !of_time(factor) && (on[factor] & on_p) == 0; });
  for (const int node : singular)
    for_factors(graph, operand(node), settled, [&](int factor) {
      const bool may_vanish = !(least[factor] > 0.0);
      // In a quotient with what vanishes as fast, nothing is singular.
      if ((may_vanish && !of_time(factor)) ||
          (is_infinite_at_zero(graph, node) && !(power_in(graph, node, factor) < 0.0)))
        return;
      bends_.push_back({factor, 1.0, false, poles[factor] != 0, of_time(factor), may_vanish,
                        may_vanish ? 0.0 : least[factor]});
    });
}

Factor Bends::length(ExpressionGraph& graph, const Bend& bend) const {
  Factor u(graph, bend.node);
  if (bend.beside) {
    const Factor square = 1.0 + u * u;
    return bend.degree == 1.0 ? sqrt(square)
                              : Factor(graph, graph.power(square.in(graph), 0.5 / bend.degree));
  }
  return length_from(u, bend.degree);
}

double Bends::length_of(std::size_t k, double u) const {
  const Bend& bend = bends_[k];
  const double s = bend.beside ? std::sqrt(1.0 + u * u) : std::abs(u);
  return bend.degree == 1.0 ? s : bend.degree == 2.0 ? std::sqrt(s) : std::pow(s, 1.0 / bend.degree);
}

void Bends::look_at(const double* z) {
  std::copy_n(z, graph_->inputs(), values_.begin());
  for (const int node : needed_) {
    const auto& [operation, a, b, number] = (*graph_)[node];
    values_[node] =
        operation == Operation::constant ? number : evaluate(operation, values_[a], values_[b < 0 ? a : b]);
  }
  for (std::size_t k = 0; k < bends_.size(); ++k)
    lengths_[k] = length_of(k, values_[bends_[k].node]);
}

void Bends::measure(const Sketch& sketch) {
  if (none()) return;
  const std::size_t count = sketch.samples.size();
  along_.clear();
  for (const Sketch::Sample& sample : sketch.samples) {
    look_at(sample.z.data());
    along_.insert(along_.end(), lengths_.begin(), lengths_.end());
  }
  for (std::size_t k = 0; k < size(); ++k) {
    Bend& bend = bends_[k];
    double low = infinity, high = 0.0, fastest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      low = std::min(low, length(i, k)), high = std::max(high, length(i, k));
      if (i > 0) fastest = std::max(fastest, speed(sketch, i - 1, k));
    }
    const bool counts = high > 4.0 * low && std::isfinite(fastest) && !bend.may_vanish;
    bend.speed = counts && is_resolved(bend.shortest, fastest * sketch.time) ? fastest : 0.0;
    speeds_[k] = bend.is_pole ? 0.0 : bend.speed;
  }
}

void Bends::forget() {
  std::ranges::fill(speeds_, 0.0);
  ahead_ = 0.0;
}

void Bends::look_ahead(const VectorX& start, double t_end) {
  const Eigen::Index last = start.size() / 2 - 1;
  VectorX z = start;
  constexpr int parts = 64;
  std::array<double, parts + 1> s{};
  for (std::size_t k = 0; k < size(); ++k) {
    if (!bends_[k].of_time) continue;
    const auto at = [&](double part) {
      z[last] = start[last] + part * (t_end - start[last]);
      look_at(z.data());
      return lengths_[k];
    };
    bool vanishes = false;
    for (int i = 0; i <= parts; ++i) {
      const double before = values_[bends_[k].node];
      s[i] = at(static_cast<double>(i) / parts);
      vanishes = vanishes || (i > 0 && !(before * values_[bends_[k].node] > 0.0));
    }
    if (bends_[k].may_vanish && vanishes) continue;
    double low = std::ranges::min(s), fastest = 0.0;
    for (int i = 1; i <= parts; ++i)
      fastest = std::max(fastest, std::abs(s[i] - s[i - 1]) * parts);
    for (int i = 1; i < parts; ++i)
      if (s[i] <= s[i - 1] && s[i] <= s[i + 1])
        low = bends_[k].may_vanish ? 0.0
                                   : std::min(low, lowest(at, (i - 1.0) / parts, (i + 1.0) / parts, false).f);
    if (!(std::ranges::max(s) > 4.0 * low) || !std::isfinite(fastest) || !is_resolved(low, fastest)) continue;
    speeds_[k] = bends_[k].speed = std::max(bends_[k].speed, fastest / std::abs(t_end - start[last]));
    ahead_ = std::max(ahead_, speeds_[k] / low);
  }
}

double Bends::time_to_nearest(const double* z) {
  look_at(z);
  double nearest = infinity;
  for (std::size_t k = 0; k < speeds_.size(); ++k)
    if (speeds_[k] > 0.0) nearest = std::min(nearest, lengths_[k] / speeds_[k]);
  return nearest;
}

bool Bends::take_missed(const Sketch& sketch) {
  double fastest = 0.0;
  for (const Sketch::Sample& sample : sketch.samples)
    fastest = std::max(fastest, sample.frequency);
  bool any = ahead_ > 10.0 * fastest;
  for (std::size_t k = 0; k < size(); ++k) {
    if (!(bends_[k].speed > 0.0) || !is_missed(sketch, k, fastest)) continue;
    any = true;
    bends_[k].is_pole = false;
    speeds_[k] = bends_[k].speed;
  }
  return any;
}

/// Returns true if a step of the sketch is many times as long as the time to bend k somewhere within it, or
/// if all frequencies are far lower.
bool Bends::is_missed(const Sketch& sketch, std::size_t k, double fastest) {
  constexpr double many = 4.0;
  VectorX inside;
  const std::size_t steps = sketch.samples.size() - 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const Sketch::Sample &from = sketch.samples[i], &to = sketch.samples[i + 1];
    double fast = bends_[k].speed;
    if (bends_[k].is_pole)  // near a pole, motion is faster than elsewhere
      fast = std::max({speed(sketch, i, k), i > 0 ? speed(sketch, i - 1, k) : 0.0,
                       i + 1 < steps ? speed(sketch, i + 1, k) : 0.0});
    const auto missed = [&](double length) {
      return fast * from.h > many * length || fastest * length < 0.1 * fast;
    };
    const double here = length(i, k), there = length(i + 1, k);
    if (missed(std::min(here, there))) return true;
    if (!missed(0.5 * (here + there - fast * from.h))) continue;  // it would have to change faster
    for (double part = 0.125; part < 1.0; part += 0.125) {
      // On the cubic polynomial between the two samples.
      const double rest = 1.0 - part, a = rest * rest * (1.0 + 2.0 * part), b = rest * rest * part * from.h,
                   c = part * part * rest * from.h;
      inside = a * from.z + (1.0 - a) * to.z + b * from.slope - c * to.slope;
      look_at(inside.data());
      if (missed(lengths_[k])) return true;
    }
  }
  return false;
}

Factor Bends::frequency(ExpressionGraph& graph, const double* speeds) const {
  Factor sum = 0.0;
  for (std::size_t k = 0; k < bends_.size(); ++k) {
    if (!(speeds[k] > 0.0)) continue;
    const Factor rate = speeds[k] * length(graph, bends_[k]).reciprocal();
    sum = sum.number == 0.0 ? rate : sum + rate;
  }
  return sum;
}

}  // namespace avi::detail
