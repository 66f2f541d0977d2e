#pragma once
#include "avi/solve.hpp"
#include "beyond/speed/work_precision/scenes/arena.hpp"
#include "common/extrapolation.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

// A problem over a span of time with its contestants: avi::solve() as users call it, and other libraries.

namespace experiment::front_door {

using work_precision::Family, work_precision::Result;

/// One race. Its families are `avi`, then the other libraries; their settings are tolerances.
using Contest = work_precision::Scene;

/// A problem with its characteristic time: a period, or 2 pi divided by the usual frequency.
struct Scene {
  std::string name;
  std::string kind;
  bool held_out;  ///< Chosen after the menu was made; not run by `--quick`.
  double unit;    ///< Characteristic time.
  /// In characteristic times, limited to where motion is regular enough for a reference.
  std::vector<double> horizons;
  std::function<Contest(double span)> make;
};

/// All scenes, in the order of the tables.
std::vector<Scene> scenes();

/// Position at the end, by extrapolation of order 20 in long double with the given number of steps. The
/// method has nothing in common with those that race.
template <class P>
Eigen::VectorXd extrapolated_end(const P& problem, const avi::State<P::dimension>& start, double span,
                                 long steps) {
  using Vec = avi::Vector<long double, 2 * P::dimension>;
  const auto field = [&](const Vec& y) {
    Vec f;
    problem.rates(y.data(), f.data());
    return f;
  };
  Vec y, low = Vec::Zero();
  y << start.q.template cast<long double>(), start.p.template cast<long double>();
  const long double h = static_cast<long double>(span) / steps;
  for (long k = 0; k < steps; ++k)
    avi::add<avi::Summation::compensated, Vec>(y, low, extrapolated_step<10>(field, y, h) - y);
  return y.template head<P::dimension>().template cast<double>();
}

/// avi::solve() as a family; the whole call is timed. Evaluations are those of the field at one stage,
/// including the trials.
template <class P>
Family door(const P& problem, const avi::State<P::dimension>& start, double span) {
  const auto run = [=](const work_precision::Request& request) {
    avi::Solution<P::dimension> found;
    Result result;
    result.seconds = work_precision::block_seconds(
        [&] { found = avi::solve(problem, start, span, request.setting); }, request.repeats);
    result.ok = found.ok();
    result.q = found.state.q;
    result.t = found.state.t;
    result.steps = found.run.steps;
    const long each = found.choice.name == "splitting" ? 1 : found.choice.order / 2;
    result.evaluations = (found.choice.sweeps + found.choice.check + found.run.evaluations) * each;
    return result;
  };
  return {"avi", 0, work_precision::Origin::front_door, "tolerance", {}, run};
}

/// The race for `problem` from `start` over `span`. @param exact the position at the end
template <class P>
Contest contest(const P& problem, const avi::State<P::dimension>& start, double span, Eigen::VectorXd exact) {
  const work_precision::Arena<P> arena(problem, span, start);
  Contest made{"", unknown, span, ""};
  made.position_error = [exact = std::move(exact)](int, double, const Eigen::VectorXd& q) {
    return (q - exact).norm();
  };
  made.families = {door(problem, start, span)};
  work_precision::add_peers(made, arena.equations());
  return made;
}

/// The same with the end extrapolated with steps of `h`; the error of that reference is its difference from a
/// run with 0.75 h.
template <class P>
Contest contest(const P& problem, const avi::State<P::dimension>& start, double span, double h) {
  const auto end = [&](double step) {
    return extrapolated_end(problem, start, span, static_cast<long>(std::ceil(span / step)));
  };
  const Eigen::VectorXd exact = end(h);
  Contest made = contest(problem, start, span, exact);
  made.reference_error = (end(0.75 * h) - exact).norm();
  return made;
}

}  // namespace experiment::front_door
