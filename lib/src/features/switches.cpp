#include "src/features/switches.hpp"

#include "avi/core/bracketed_root.hpp"
#include "src/autodiff/schedule.hpp"
#include "src/features/separable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace avi::detail {

namespace {

/// Finds the causes that make H switch, and adds their nodes to the graph.
std::vector<Switches::Cause> causes_of(ExpressionGraph& graph, int energy) {
  using enum Operation;
  const std::vector<char> part = graph.parts(energy);
  const std::vector<unsigned char> on = dependences(graph, energy);
  std::vector<Switches::Cause> causes;
  for (int i = 0; i <= energy; ++i) {
    const ExpressionGraph::Node node = graph[i];
    if (!part[i] || on[i] != on_last) continue;
    Switches::Cause cause;
    if (node.operation == less)
      cause.node = cause.bends = graph.binary(subtract, node.a, node.b);
    else if (node.operation == less_equal)  // false where b < a
      cause.node = cause.bends = graph.binary(subtract, node.b, node.a);
    else if (node.operation == abs || node.operation == sign)
      cause.node = cause.bends = node.a;
    else if (node.operation == floor)
      cause = {node.a, graph.unary(sin, graph.binary(multiply, graph.constant(M_PI), node.a)), true};
    const bool known = std::ranges::find(causes, cause) != causes.end();
    if (cause.node >= 0 && !known) causes.push_back(cause);
  }
  return causes;
}

/// Makes the Taylor series of what a cause compares, with the arguments of functions in it that are flat away
/// from where they change: where they are flat, the series says nothing about that change.
Switches::Expansion expansion_of(const ExpressionGraph& graph, const Switches::Cause& cause) {
  using enum Operation;
  const std::vector<char> part = graph.parts(cause.node);
  std::vector<int> nodes{cause.node};
  std::vector<char> falls;
  for (int i = 0; i <= cause.node; ++i) {
    const Operation what = graph[i].operation;
    if (!part[i] || !(what == exp || what == tanh || what == erf || what == erfc)) continue;
    nodes.push_back(graph[i].a);
    falls.push_back(what == exp);
  }
  TaylorSeries<DualNumber<1>> series(graph, {}, nodes, Switches::order);
  for (int& node : nodes)
    node = series.place(node);
  return {std::move(series), std::move(nodes), std::move(falls)};
}

/// Computes the series in time, about t.
void expand(TaylorSeries<DualNumber<1>>& series, int inputs, double t) {
  for (int i = 0; i < inputs; ++i)
    std::fill_n(series.input(i), Switches::order + 2, DualNumber<1>(0.0));
  DualNumber<1>* const time = series.input(inputs / 2 - 1);
  time[0] = t, time[1] = 1.0;
  for (int k = 0; k <= Switches::order; ++k)
    series.run(k, true);
}

/// A time in which the function of each cause bends a few times at most: over it, the lower half of its
/// Taylor series outweighs the upper half.
double time_of_bends(const ExpressionGraph& graph, const std::vector<Switches::Cause>& causes, double from,
                     double span) {
  constexpr int order = Switches::order, looks = 64;
  std::vector<int> nodes;
  for (const Switches::Cause& cause : causes)
    nodes.push_back(cause.bends);
  TaylorSeries<DualNumber<1>> series(graph, {}, nodes, order);
  double radius = std::abs(span);
  for (int look = 0; look < looks; ++look) {
    // Not at equal distances, which might be multiples of a period.
    const double place = look * 0.6180339887498949;
    expand(series, graph.inputs(), from + span * (place - std::floor(place)));
    for (const int node : nodes) {
      const DualNumber<1>* const c = series.output(series.place(node));
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

Program program_of(const ExpressionGraph& graph, const std::vector<Switches::Cause>& causes) {
  std::vector<int> nodes;
  for (const Switches::Cause& cause : causes)
    nodes.push_back(cause.node);
  return Schedule::program(graph, -1, nodes, graph.size());
}

}  // namespace

std::shared_ptr<const Switches> Switches::of(const ExpressionGraph& graph, int energy, double from,
                                             double to) {
  ExpressionGraph more = graph;
  std::vector<Cause> causes = causes_of(more, energy);
  if (causes.empty() || from == to) return nullptr;
  const double far = std::max(std::abs(from), std::abs(to)), span = std::abs(to - from);
  const double cell = std::max(std::min(32.0 * time_of_bends(more, causes, from, to - from), 0.125 * span),
                               64.0 * std::numeric_limits<double>::epsilon() * far);
  return std::shared_ptr<const Switches>(new Switches(more, energy, std::move(causes), from, cell));
}

Switches::Switches(const ExpressionGraph& graph, int energy, std::vector<Cause> causes, double from,
                   double cell)
    : n_(graph.inputs() / 2), from_(from), cell_(cell), causes_(std::move(causes)),
      compared_{program_of(graph, causes_)}, energy_{Schedule::program(graph, energy, {}, graph.size())},
      at_(static_cast<std::size_t>(2 * n_), 0.0), seen_(std::numeric_limits<double>::quiet_NaN()) {
  for (const Cause& cause : causes_)
    expansions_.push_back(expansion_of(graph, cause));
}

/// Value at a time of the function of a cause, which is compared with zero or with whole numbers.
double Switches::value(std::size_t cause, double t) {
  at_[static_cast<std::size_t>(n_ - 1)] = t;
  compared_.run(at_.data(), at_.data() + n_, n_);
  return compared_.partial(static_cast<int>(cause));
}

/// Adds the switches of a cause between two points.
void Switches::add_between(std::size_t cause, const Point& low, const Point& high) {
  if (!causes_[cause].whole) return add_zero(cause, 0.0, low, high);
  constexpr int most = 1000;  // whole numbers; a cell has a few of them
  const double least = std::floor(std::min(low.value, high.value)), last = std::max(low.value, high.value);
  for (int k = 1; k <= most && least + k <= last; ++k)
    add_zero(cause, least + k, low, high);
}
void Switches::add_zero(std::size_t cause, double bound, const Point& low, const Point& high) {
  const double first = low.value - bound, last = high.value - bound;
  const bool falls = last < 0.0;
  if ((first < 0.0) == falls || !std::isfinite(first) || !std::isfinite(last)) return;
  // An exact zero counts as not negative, in both directions.
  const auto rising = [&](double x) { return !falls ? x : x == 0.0 ? -0x1p-1074 : -x; };
  const auto f = [&](double t) { return rising(value(cause, t) - bound); };
  const Root zero = bracketed_root(f, low.t, rising(first), high.t, rising(last), -1.0);
  if (!zero.closed) return;
  // A run may begin at any of the few numbers that are left, so find neighbouring ones.
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

/// Bounds on the function of a cause within `distance` of a time, from its series there.
Switches::Outlook Switches::outlook(std::size_t cause, double t, double distance) {
  Expansion& its = expansions_[cause];
  expand(its.series, static_cast<int>(2 * n_), t);
  const auto spread = [&](const DualNumber<1>* c, int from, bool of_slope = false) {
    double sum = 0.0, power = of_slope ? 1.0 : distance;
    for (int k = 1; k <= order; ++k, power *= distance)
      if (k >= from) sum += std::abs(value_of(c[k])) * power * (of_slope ? k : 1);
    return sum;
  };
  const DualNumber<1>* const c = its.series.output(its.places[0]);
  const double middle = value_of(c[0]), around = spread(c, 1), rest = spread(c, order - 1);
  bool known = std::isfinite(middle) && rest <= 0.1 * std::max(std::abs(middle), around);
  for (std::size_t k = 1; k < its.places.size() && known; ++k) {
    const DualNumber<1>* const a = its.series.output(its.places[k]);
    const double argument = value_of(a[0]), change = spread(a, 1);
    const bool flat = its.falls[k - 1] ? argument + change < -50.0 : std::abs(argument) - change > 20.0;
    known = flat || change <= 8.0;
  }
  const double turning = 1.1 * spread(c, 2, true);
  return {known, middle - 1.1 * around, middle + 1.1 * around, std::abs(value_of(c[1])) > turning};
}

/// Finds where a cause switches between two points, by bisection, until its series shows no zero in an
/// interval, or one at most.
void Switches::search(std::size_t cause, const Point& low, const Point& high) {
  const double half = 0.5 * (high.t - low.t), middle = low.t + half;
  if (!(half > 32.0 * rounding(middle)) || looks_ > most_looks) return add_between(cause, low, high);
  ++looks_;
  const auto side = [&](double x) { return causes_[cause].whole ? std::floor(x) : x < 0.0 ? -1.0 : 0.0; };
  if (const Outlook it = outlook(cause, middle, half); it.known) {
    const double first = side(low.value);
    if (side(it.least) == side(it.most) && side(it.least) == first && side(high.value) == first) return;
    if (it.monotone) return add_between(cause, low, high);
  }
  const Point between{middle, value(cause, middle)};
  search(cause, low, between);
  search(cause, between, high);
}

/// Finds the switches of a cell, one cause after the other: the function of a cause may jump where an earlier
/// one switches.
void Switches::look_into(double cell) {
  if (cell == seen_) return;
  seen_ = cell;
  looks_ = 0;
  inside_.clear();
  for (std::size_t i = 0; i < causes_.size(); ++i) {
    const std::vector<Switch> known = inside_;
    double low = edge(cell);
    const auto search_to = [&](double high) {
      if (low < high) search(i, {low, value(i, low)}, {high, value(i, high)});
    };
    for (const Switch& it : known) {
      search_to(it.before);
      low = it.after;
    }
    search_to(edge(cell + 1.0));
    std::ranges::sort(inside_, {}, &Switch::before);
    // Switches that only rounding tells apart are one.
    std::size_t last = 0;
    for (std::size_t k = 1; k < inside_.size(); ++k)
      if (inside_[k].before <= inside_[last].after + 64.0 * rounding(inside_[k].before))
        inside_[last].after = std::max(inside_[last].after, inside_[k].after);
      else
        inside_[++last] = inside_[k];
    if (!inside_.empty()) inside_.resize(last + 1);
  }
}

std::optional<Switches::Switch> Switches::next(double t, double to) {
  if (!std::isfinite(t) || !std::isfinite(to)) return {};
  const bool back = to < t;
  double cell = std::floor((t - from_) / cell_);
  while (t < edge(cell))
    --cell;
  while (t >= edge(cell + 1.0))
    ++cell;
  for (int looks = 0; looks <= most_looks; cell += back ? -1.0 : 1.0) {
    look_into(cell);
    looks += looks_ + 1;
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
  // A switch around t is found from before it.
  const auto found = next(t - 64.0 * sense * rounding(t), t + sense * rounding(t));
  if (!found || !(sense * (found->after - t) > 0.0)) return {};
  return Switch{t, found->after};
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
