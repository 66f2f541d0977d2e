#include "avi/problems/kepler.hpp"
#include "beyond/speed/cost_growth/axes.hpp"
#include "common/methods/methods.hpp"
#include "common/methods/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

// Kepler's problem: cost and eccentricity, horizon, and Taylor order of one expansion.

namespace experiment {
namespace {

constexpr double period = 2.0 * M_PI;
constexpr double target = 1e-6, tolerance = 0.03;

/// A function that runs a new method on every call.
auto runs_of(const Method2& runner, const State2& start, double h, const avi::Until& until) {
  return [=] {
    State2 z = start;
    avi::AnyMethod<2> method = runner.make(start);
    return avi::integrate(method, z, h, until);
  };
}

Measurement measured(std::string subject, double value, const Method2& runner, const State2& start, double h,
                     double time) {
  const Attempt made =
      attempt(runner, start, h, {.time = time, .steps = 10'000'000, .energy_error = HUGE_VAL});
  return {std::move(subject), value, made.run.steps, made.energy_error,
          runs_of(runner, start, h, {.time = time})};
}

/// The step for which the largest energy error over one orbit equals the target, within `tolerance` if such a
/// step exists. It is halved from `h` until the error comes near, then corrected in logarithms with order 8.
/// NaN if that takes more than `cap` steps.
double calibrated(const Method2& runner, const State2& start, double h, long cap) {
  const Limits limits{.time = period, .steps = cap, .energy_error = 100.0 * target};
  const auto error = [&](double tried) {
    const Attempt made = attempt(runner, start, tried, limits);
    if (made.run.outcome == avi::Outcome::step_limit) return std::nan("");
    return made.good() ? made.energy_error : HUGE_VAL;
  };
  return matched_step(error, target, h,
                      {.order = 8.0, .within = tolerance, .longest = 2.0, .too_coarse = 1e3});
}

/// The integral of r^-m dt over an orbit with e = 1 - gap, in terms of the eccentric anomaly E, with
/// r = 1 - e cos E and dt = r dE. The substitution E = sqrt(2 gap) sinh u resolves the pericentre.
double orbit_integral(double m, double gap) {
  constexpr int cells = 4000;
  const double scale = std::sqrt(2.0 * gap), end = std::asinh(M_PI / scale);
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double u = end * (i + 0.5) / cells, half = std::sin(0.5 * scale * std::sinh(u));
    const double r = gap + 2.0 * (1.0 - gap) * half * half;
    sum += std::pow(r, 1.0 - m) * scale * std::cosh(u) * end / cells;
  }
  return 2.0 * sum;
}

}  // namespace

Axis along_eccentricity(bool quick) {
  Axis axis{"closeness"};
  // Near the pericentre, time and energy scale as r^1.5 and 1/r. Order 8 with g = r^m therefore needs
  // h r^m <= r^1.5 r^(1/8) there. An orbit then takes the integral of r^-m dt / h steps, which grows as
  // r^(1.5 - m) for m > 1.5, and as a logarithm for m = 1.5.
  //
  // For m > 1.5 the apocentre limits h. As a function of tau, a fall from rest has poles at distances +-i d
  // from its apocentre (for m = 2 it is r = 2 / (1 + tau^2)). They leave an error proportional to
  // exp(-2 pi d / h) in the conserved g (H + p^t), which at the pericentre is an energy error (2 / (1 - e))^m
  // times as large. So 2 pi d / h is log(1 / target) + m log(2 / (1 - e)), and the number of steps grows by
  // that logarithm as well.
  const auto survey = [&](const std::string& name, const PositionMonitor& monitor, double m, double first) {
    const Method2 runner = stationary(8, monitor);
    const double limited = std::max(0.0, 1.625 - m), power = -limited - std::max(0.0, m - 1.5);
    double h = first;
    // Without a monitor a run soon needs more steps than the cap, so the points are closer together.
    const double spacing = m > 0.0 ? 0.5 : 0.125;
    for (double power_of_ten = 1.0; power_of_ten < 6.01; power_of_ten += spacing) {
      const double gap = std::pow(10.0, -power_of_ten);
      const State2 start = avi::Kepler::pericentre(1.0 - gap);
      h = calibrated(runner, start, h, quick ? 20'000 : 40'000);
      if (std::isnan(h)) break;
      Measurement made = measured(name, gap, runner, start, h, period);
      // Nearer to the parabola rounding is as large as the target, and no step has that error.
      if (std::abs(std::log(made.energy_error / target)) > tolerance) break;
      axis.runs.push_back(std::move(made));
      h *= std::pow(0.1, spacing * limited);
    }
    // Rounding of g (H + p^t) at the apocentre is an energy error (2 / (1 - e))^m times as large at the
    // pericentre.
    const double rounding = m > 0.0 ? 2.0 * std::pow(1e-3 * target / 2e-16, -1.0 / m) : 0.0;
    axis.expected.push_back({name, power, rounding, 0.2, [=](double gap) {
                               const double by_poles = std::log(1.0 / target) + m * std::log(2.0 / gap);
                               return (m > 1.5 ? by_poles : std::pow(gap, -limited)) * orbit_integral(m, gap);
                             }});
  };
  survey("none", {.kind = PositionMonitor::none}, 0.0, 0.003);
  for (double gamma : {0.5, 0.625, 0.75, 0.875, 1.0})
    survey(fmt::format("gamma = {:g}", gamma),
           {.kind = PositionMonitor::power_of_radius, .exponent = 2.0 * gamma}, 2.0 * gamma, 0.2);
  return axis;
}

Axis along_horizon(bool quick) {
  Axis axis{"periods"};
  const State2 start = avi::Kepler::pericentre(0.9);
  const auto survey = [&](const std::string& name, const Method2& runner, double h) {
    for (double periods : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0})
      if (!quick || periods < 50.0)
        axis.runs.push_back(measured(name, periods, runner, start, h, periods * period));
    axis.expected.push_back({name, 1.0, 1.0, 1e3});
  };
  survey("stationary8", stationary(8, {.kind = PositionMonitor::power_of_radius, .exponent = 1.5}), 0.1);
  survey("stormer_verlet", explicit_on_kepler("stormer_verlet"), 1e-3);
  survey("log_hamiltonian", explicit_on_kepler("log_hamiltonian"), 0.05);
  return axis;
}

Axis along_order() {
  const State2 start = avi::Kepler::pericentre(0.5);
  constexpr PositionMonitor monitor{.kind = PositionMonitor::power_of_radius, .exponent = 1.5};
  constexpr double h = 0.05;
  Axis axis{"order"};
  for (int r = 0; r <= 15; ++r) {
    const auto again = runs_of(stationary(2 * r + 2, monitor), start, h, {.steps = 100});
    const avi::Run run = again();
    axis.runs.push_back({"stationary", 1.0 * r, run.steps, unknown, again, 1.0 * run.evaluations});
  }
  axis.expected.push_back({"stationary", unknown, 4.0, 15.0});
  return axis;
}

}  // namespace experiment
