#pragma once
#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/htvi/htvi.hpp"
#include "common/extrapolation.hpp"
#include "common/methods/printed_htvi.hpp"
#include "common/table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

// Measured order of HTVI for every Taylor order, rule, type and construction on one problem. The Taylor
// order is chosen at run time, so each problem and type compiles once.

namespace experiment {

inline std::vector<avi::Quadrature> order_rules() {
  return {avi::rectangle_left(), avi::midpoint(), avi::trapezoid(), avi::radau(2),
          avi::simpson(),        avi::gauss(2),   avi::radau(3),    avi::boole(),
          avi::gauss(3),         avi::lobatto(4), avi::gauss(4),    avi::lobatto(5),
          avi::radau(5),         avi::gauss(5),   avi::gauss(6),    avi::lobatto(7)};
}

/// Slopes of the error over the step.
struct Slopes {
  avi::OrderFit finest;  ///< Through the finest four steps that rounding does not touch.
  double limit;          ///< Extrapolated to h = 0 from that and the slope of the four steps before it.
};

/// Slopes of error(N), at the end of [0, horizon] in fictive time after N steps. Slopes of longer steps are
/// not yet the order. Where the leading two terms of the error cancel at some step, slopes of finer ones come
/// to the order from below, s(h) = p + c h + O(h^2): Richardson's extrapolation gives p.
inline Slopes slopes_of(const std::function<double(int)>& error, double horizon, int most_steps) {
  std::vector<double> h, errors;
  for (int n = 2; n <= most_steps; n = std::max(n + 1, n * 6 / 5)) {
    h.push_back(horizon / n);
    errors.push_back(error(n));
    if (errors.back() < 2e-14) break;
  }
  // Rounding adds up over the steps; NaN is not usable.
  const auto usable = [&](std::size_t i) { return errors[i] > 2e-15 * (20.0 + horizon / h[i]); };
  std::size_t last = errors.size();
  while (last > 0 && !usable(last - 1))
    --last;
  // Up to four points that end before `end`.
  const auto begin_of = [&](std::size_t end) {
    std::size_t first = end;
    while (first > 0 && end - first < 4 && usable(first - 1))
      --first;
    return first;
  };
  const auto fit = [&](std::size_t first, std::size_t end) {
    return avi::fit_order(std::span(h).subspan(first, end - first),
                          std::span(errors).subspan(first, end - first), {.at_least = 3});
  };
  const std::size_t first = begin_of(last), before = begin_of(first);
  const auto finest = fit(first, last);
  double limit = std::nan("");
  if (last - first == 4 && first - before == 4) {
    const double fine = std::sqrt(h[first] * h[last - 1]), coarse = std::sqrt(h[before] * h[first - 1]);
    limit = finest.order + (finest.order - fit(before, first).order) * fine / (coarse - fine);
  }
  return {finest, limit};
}

/// Adds a row for every Taylor order and rule. The order expected is a lower bound: stationary
/// min(2r + 2, max(r + 1, s)), others min(r + 1, s).
template <avi::Generating type, class Construction, class Problem, class State>
void add_cells(Table& table, const std::string& name, const Problem& problem, const State& start,
               double horizon, const std::function<double(const State&)>& error, bool quick) {
  constexpr bool stationary = std::is_same_v<Construction, avi::Stationary>;
  const auto rules = order_rules();
  for (int r = 0; r <= (quick ? 2 : 4); ++r)
    for (const auto& rule : rules) {
      // Between these the rule limits the order to s, but with a small factor (5e-7 for three Gauss nodes):
      // at the steps that rounding leaves, that term and the one of order 2r + 2 compete, and a slope tells
      // neither.
      if (stationary && rule.order > r + 1 && rule.order < 2 * r + 2) continue;
      const auto error_after = [&](int steps) {
        auto method = avi::htvi_of_order<type, Construction>(r, problem, rule);
        State z = start;
        const auto run = avi::integrate(method, z, horizon / steps, {.steps = steps});
        return run.outcome == avi::Outcome::ok ? error(z) : std::nan("");
      };
      const auto [finest, limit] = slopes_of(error_after, horizon, quick ? 1000 : 2000);
      const int expected =
          stationary ? std::min(2 * r + 2, std::max(rule.order, r + 1)) : std::min(r + 1, rule.order);
      table.row(name, type == avi::Generating::type2 ? "II" : "III", r, rule.name, expected, finest.order,
                stationary ? "stationary" : "printed", finest.points, limit);
    }
}

/// (q, p, t) in extended precision.
template <int n>
using ExtendedPoint = avi::Vector<long double, 2 * n + 1>;

/// The point at fictive time `horizon`, of order 16: 200 steps leave less than 1e-16 on the problems of this
/// experiment.
template <class Problem>
ExtendedPoint<Problem::dimension>
extended_reference(const Problem& problem, const avi::State<Problem::dimension>& start, double horizon) {
  constexpr int n = Problem::dimension, steps = 200;
  const auto field = [&](const ExtendedPoint<n>& z) {
    const avi::Vector<long double, n> q = z.template head<n>(), p = z.template segment<n>(n);
    avi::Vector<long double, n> dq, dp;
    long double dt;
    problem.field(q, p, static_cast<long double>(problem.energy_momentum()), dq, dp, dt);
    ExtendedPoint<n> dz;
    dz << dq, -dp, dt;
    return dz;
  };
  ExtendedPoint<n> z;
  z << start.q.template cast<long double>(), start.p.template cast<long double>(),
      static_cast<long double>(start.t);
  for (int k = 0; k < steps; ++k)
    z = extrapolated_step<8>(field, z, static_cast<long double>(horizon) / steps);
  return z;
}

/// Both types, stationary and as printed. The error is that of (q, p, t).
template <class Problem>
void add_problem(Table& table, const std::string& name, const Problem& problem,
                 const avi::State<Problem::dimension>& start, double horizon, bool quick) {
  constexpr int n = Problem::dimension;
  ExtendedPoint<n> exact = extended_reference(problem, start, horizon);
  // Where time is a coordinate, q holds it.
  const long double exact_time = problem.clock(start.q, -1.0) != -1.0 ? exact[n - 1] : exact[2 * n];
  exact[2 * n] = 0.0L;
  const std::function<double(const avi::State<n>&)> error = [&](const avi::State<n>& z) {
    ExtendedPoint<n> point;
    point << z.q.template cast<long double>(), z.p.template cast<long double>(),
        static_cast<long double>(z.t) - exact_time;
    return static_cast<double>((point - exact).norm());
  };
  const auto add = [&]<class Construction>() {
    using avi::Generating;
    add_cells<Generating::type2, Construction>(table, name, problem, start, horizon, error, quick);
    add_cells<Generating::type3, Construction>(table, name, problem, start, horizon, error, quick);
  };
  add.template operator()<avi::Stationary>();
  add.template operator()<Printed>();
}

}  // namespace experiment
