#include "switches.hpp"

#include "avi/autodiff/taylor_series.hpp"
#include "avi/core/bracketed_root.hpp"
#include "schedule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace avi::detail {

namespace {

/// Nodes that make H switch where they become negative, or no longer are; added to the graph.
std::vector<int> differences(ExpressionGraph& graph, int energy) {
  using enum Operation;
  const std::vector<char> part = graph.parts(energy), timed = Switches::of_time_alone(graph, energy);
  std::vector<int> nodes;
  for (int i = 0; i <= energy; ++i) {
    const ExpressionGraph::Node node = graph[i];
    if (!part[static_cast<std::size_t>(i)] || !timed[static_cast<std::size_t>(i)]) continue;
    int difference = -1;
    if (node.operation == less)
      difference = graph.binary(subtract, node.a, node.b);
    else if (node.operation == less_equal)  // which is wrong where b < a
      difference = graph.binary(subtract, node.b, node.a);
    else if (node.operation == abs || node.operation == sign)
      difference = node.a;
    if (difference >= 0 && std::ranges::find(nodes, difference) == nodes.end()) nodes.push_back(difference);
  }
  return nodes;
}

/// A time in which each of these functions of time bends a few times at most: the low half of its Taylor
/// series has more than the high one. @param inputs of the graph, the last coordinate time
double time_of_bends(const ExpressionGraph& graph, const std::vector<int>& nodes, double from, double span) {
  using Number = DualNumber<1>;
  constexpr int order = 8, looks = 64;
  TaylorSeries<Number> series(graph, {}, nodes, order);
  double radius = std::abs(span);
  for (int look = 0; look < looks; ++look) {
    // Not at equal distances, which a period may divide.
    const double place = look * 0.6180339887498949;
    for (int i = 0; i < graph.inputs(); ++i)
      std::fill_n(series.input(i), order + 2, Number(0.0));
    Number* const time = series.input(graph.inputs() / 2 - 1);
    time[0] = Number(from + span * (place - std::floor(place))), time[1] = Number(1.0);
    for (int k = 0; k <= order; ++k)
      series.run(k, true);
    for (const int node : nodes) {
      const Number* const c = series.output(series.place(node));
      const auto bends = [&] {
        double low = 0.0, high = 0.0, power = 1.0;
        for (int k = 1; k <= order; ++k) {
          power *= radius;
          double& half = k <= order / 2 ? low : high;
          half = std::max(half, std::abs(value_of(c[k])) * power);
        }
        return high > 0.5 * low && std::isfinite(high);
      };
      for (int halves = 0; halves < 1000 && bends(); ++halves)
        radius *= 0.5;
    }
  }
  return radius;
}

}  // namespace

std::vector<char> Switches::of_time_alone(const ExpressionGraph& graph, int energy) {
  std::vector<char> fixed(static_cast<std::size_t>(energy) + 1), timed(fixed.size());
  const int time = graph.inputs() / 2 - 1;
  for (int i = 0; i <= energy; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const ExpressionGraph::Node& node = graph[i];
    if (node.operation == Operation::input) {
      timed[at] = node.a == time;
      continue;
    }
    bool others = false, time_in_it = false;
    for (const int operand : {node.a, node.b})
      if (operand >= 0 && node.operation != Operation::constant) {
        const auto it = static_cast<std::size_t>(operand);
        time_in_it = time_in_it || timed[it];
        others = others || !(timed[it] || fixed[it]);
      }
    timed[at] = time_in_it && !others;
    fixed[at] = !time_in_it && !others;
  }
  return timed;
}

std::shared_ptr<const Switches> Switches::of(const ExpressionGraph& graph, int energy, double from,
                                             double to) {
  ExpressionGraph more = graph;
  const std::vector<int> nodes = differences(more, energy);
  if (nodes.empty() || from == to) return nullptr;
  const double far = std::max(std::abs(from), std::abs(to)), span = std::abs(to - from);
  const double cell = std::max(0.5 * std::min(time_of_bends(more, nodes, from, to - from), 0.125 * span),
                               64.0 * std::numeric_limits<double>::epsilon() * far);
  return std::shared_ptr<const Switches>(new Switches(more, energy, nodes, from, cell));
}

Switches::Switches(const ExpressionGraph& graph, int energy, const std::vector<int>& differences, double from,
                   double cell)
    : n_(graph.inputs() / 2), from_(from),
      cell_(cell), differences_{Schedule::program(graph, -1, differences, graph.size())},
      energy_{Schedule::program(graph, energy, {}, graph.size())}, at_(static_cast<std::size_t>(2 * n_), 0.0),
      seen_(std::numeric_limits<double>::quiet_NaN()) {}

/// A difference at a time.
double Switches::value(std::size_t difference, double t) {
  at_[static_cast<std::size_t>(n_ - 1)] = t;
  differences_.run(at_.data(), at_.data() + n_, n_);
  return differences_.partial(static_cast<int>(difference));
}

/// Where a difference, times its sign, is lowest between two times, by golden section.
double Switches::lowest(std::size_t difference, double sign, double low, double high) {
  constexpr double golden = 0.6180339887498949;
  const auto size = [&](double t) { return sign * value(difference, t); };
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = size(a), at_b = size(b);
  for (int i = 0; i < 40; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = size(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = size(b);
    }
  }
  return 0.5 * (low + high);
}

/// Adds where a difference becomes negative, or no longer is, between two times.
void Switches::add_zero(std::size_t difference, const Point& low, const Point& high) {
  const bool falls = high.value < 0.0;
  if ((low.value < 0.0) == falls) return;
  constexpr double least =
      std::numeric_limits<double>::denorm_min();  // of what is zero, on the side it counts to
  const auto rising = [&](double x) { return !falls ? x : x == 0.0 ? -least : -x; };
  if (!std::isfinite(low.value) || !std::isfinite(high.value)) return;
  const auto f = [&](double t) { return rising(value(difference, t)); };
  const Root zero = bracketed_root(f, low.t, rising(low.value), high.t, rising(high.value), -1.0);
  if (!zero.closed) return;
  // A run may begin at any of the few numbers that are left.
  Switch found{zero.low, zero.high};
  for (bool by_exponent = false;; by_exponent = !by_exponent) {
    const double middle = detail::middle(found.before, found.after, by_exponent);
    if (!(middle > found.before && middle < found.after)) {
      if (!by_exponent) break;
      continue;
    }
    (f(middle) < 0.0 ? found.before : found.after) = middle;
  }
  inside_.push_back(found);
}

/// Finds the switches of a cell.
void Switches::look_into(double cell) {
  if (cell == seen_) return;
  seen_ = cell;
  inside_.clear();
  const double low = edge(cell), high = edge(cell + 1.0), step = (high - low) / parts;
  const auto count = static_cast<std::size_t>(differences_.program.slopes());
  // One more at each side, for what comes near zero at the edges.
  std::array<double, parts + 3> times;
  points_.resize(count);
  for (std::size_t k = 0; k < times.size(); ++k) {
    times[k] = k == 1 ? low : k == parts + 1 ? high : low + (static_cast<double>(k) - 1.0) * step;
    (void)value(0, times[k]);
    for (std::size_t i = 0; i < count; ++i)
      points_[i][k] = {times[k], differences_.partial(static_cast<int>(i))};
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto& at = points_[i];
    for (std::size_t k = 1; k <= parts; ++k)
      add_zero(i, at[k], at[k + 1]);
    for (std::size_t k = 1; k <= parts + 1; ++k) {
      const double before = at[k - 1].value, here = at[k].value, after = at[k + 1].value;
      const bool dips = before * here > 0.0 && here * after > 0.0 && std::abs(here) <= std::abs(before) &&
                        std::abs(here) < std::abs(after);
      if (!dips) continue;
      const double t = lowest(i, std::copysign(1.0, here), at[k - 1].t, at[k + 1].t);
      const Point there{t, value(i, t)};
      add_zero(i, at[k - 1], there), add_zero(i, there, at[k + 1]);
    }
  }
  // Of two cells that have found the same one keeps it; several at one time are one.
  std::erase_if(inside_, [&](const Switch& it) { return it.before < low || it.after > high; });
  std::ranges::sort(inside_, {}, &Switch::before);
  std::size_t last = 0;
  for (std::size_t k = 1; k < inside_.size(); ++k)
    if (inside_[k].before <= inside_[last].after)
      inside_[last].after = std::max(inside_[last].after, inside_[k].after);
    else
      inside_[++last] = inside_[k];
  if (!inside_.empty()) inside_.resize(last + 1);
}

std::optional<Switches::Switch> Switches::next(double t, double to) {
  if (!std::isfinite(t) || !std::isfinite(to)) return {};
  const bool back = to < t;
  double cell = std::floor((t - from_) / cell_);
  while (t < edge(cell))
    --cell;
  while (t >= edge(cell + 1.0))
    ++cell;
  for (int cells = 0; cells < most_cells; ++cells, cell += back ? -1.0 : 1.0) {
    look_into(cell);
    if (back) {
      for (auto it = inside_.rbegin(); it != inside_.rend(); ++it)
        if (it->after <= t)
          return it->after >= to ? std::optional(Switch{it->after, it->before}) : std::nullopt;
      if (edge(cell) < to) return {};
    } else {
      for (const Switch& it : inside_)
        if (it.before >= t) return it.before <= to ? std::optional(it) : std::nullopt;
      if (edge(cell + 1.0) > to) return {};
    }
  }
  return {};
}

std::optional<Switches::Switch> Switches::at(double t, double sense) {
  const double near = std::numeric_limits<double>::epsilon() * std::max(std::abs(t), cell_);
  return next(t, t + sense * near);
}

double Switches::fall(const double* q, const double* p, const Switch& at) {
  std::vector<double> there(q, q + n_);
  const auto energy = [&](double t) {
    there.back() = t;
    energy_.run(there.data(), p, n_);
    return energy_.value();
  };
  const double before = energy(at.before);
  return before - energy(at.after);
}

}  // namespace avi::detail
