#pragma once
#include "beyond/speed/automatic_monitors/orbit_scales.hpp"
#include "beyond/speed/automatic_monitors/pilot.hpp"

#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

/// @file
/// A monitor chosen from a menu by a short run.

namespace experiment {

using avi::ExpressionGraph, avi::Operation, avi::require, avi::require_positive;

/// What a pilot run is to reach.
struct MonitorTarget {
  double energy_error = 1e-8;  ///< Largest |H - H_0|, relative to the energy scale of choose_monitor().
  int order = 8;               ///< Of the collocation method.
  double time = 0.0;           ///< Length of the trials; 0 takes the first 10 radians, see choose_monitor().
};

/// A monitor with the step that goes with it. From here on both are fixed, and a method is the symplectic map
/// that it would be with a monitor made by hand.
struct MonitorChoice {
  std::string name;           ///< In the menu: see choose_monitor().
  Formula monitor;            ///< g.
  int order = 0;              ///< Of the collocation method that it was chosen for.
  double h = 0.0;             ///< Fictive step for the energy error asked for.
  bool reached = false;       ///< A trial met the energy error asked for.
  double energy_scale = 1.0;  ///< What energy errors are relative to, see choose_monitor().
  double time = 0.0;          ///< Physical time of a trial.
  long sweeps = 0;            ///< Evaluations of all stages in all trials, what the pilot cost.
  double work = 0.0;          ///< The same in additions, the run that finds the scales included.
  std::vector<Trial> trials;  ///< In their order.
  std::string note;           ///< Why the menu was short; empty where it was not.

  /// The trials as a table and what follows from them.
  [[nodiscard]] std::string report() const {
    std::ostringstream text;
    text.precision(3);
    for (const Trial& trial : trials)
      text << "  " << trial.monitor << ": h = " << trial.h << ", " << trial.steps << " steps, "
           << trial.sweeps << " sweeps, energy error " << trial.energy_error << ", "
           << avi::name(trial.outcome) << "\n";
    if (!note.empty()) text << "  " << note << "\n";
    if (reached)
      text << "Chosen: " << name << ", order " << order << ", h = " << h
           << ", the least work for the energy error asked for in a pilot of time " << time << " (" << sweeps
           << " sweeps).\n";
    else
      text << "No monitor of the menu reached the energy error asked for in a pilot of time " << time
           << ".\n";
    return text.str();
  }
};

/// The candidate monitors of H as formulas of (q, p); their constants are scales of the orbit.
class Monitors {
 public:
  /// For this orbit. @throws std::invalid_argument where it has no time scale, or speeds have no measure
  explicit Monitors(const Orbit& orbit)
      : energy_at_start_(orbit.energy_at_start()), curvature_(orbit), scales_(orbit, curvature_),
        curvature_node_(curvature_monitor(curvature_, scales_)) {}

  /// A monitor with its name, and H times it: what a method has to work through.
  struct Entry {
    std::string name;
    Formula monitor, transformed;
  };

  /// automatic_monitor().
  Entry curvature() { return entry("curvature", curvature_node_); }
  /// \f$g = \big((n_0 + (\bar\omega/4)^4)^{1/4} + \bar\omega\big)^{-1}\f$: below one over the mean frequency.
  Entry gentle() {
    const int smooth = plus(scales_.n0, std::pow(0.25 * scales_.frequency, 4));
    return entry("gentle", power(plus(power(smooth, 0.25), scales_.frequency), -1.0));
  }
  /// \f$g = (1 + S/\bar S)^{-1/2}\f$ with the squared speed S in phase space and its mean.
  Entry speed() {
    const int speed =
        curvature_.scaled(1.0 / scales_.squared_speed, curvature_.squared_speed(scales_.frequency));
    return entry("speed", power(plus(speed, 1.0), -0.5));
  }
  /// \f$g = (\bar T + \frac12(H + H_0) - H(q, 0))^{-\alpha}\f$ with the mean kinetic energy. On the orbit
  /// H(q, p) - H(q, 0) could stand there as well; the half makes \f$\bar H_{qp}\f$ zero, see \ref monitors.
  Entry energy(const std::string& name, double exponent) {
    const int half = curvature_.scaled(0.5, curvature_.energy);
    const int moving = curvature_.graph.binary(Operation::subtract, half, curvature_.energy_at_rest());
    const int lively = plus(moving, 0.5 * energy_at_start_ + scales_.kinetic);
    return entry(name, power(lively, -exponent));
  }
  /// 1, no monitor.
  Entry fixed() { return entry("fixed", curvature_.graph.constant(1.0)); }
  [[nodiscard]] const OrbitScales& scales() const { return scales_; }  ///< The scales.

 private:
  int plus(int a, double b) { return curvature_.plus(a, curvature_.graph.constant(b)); }
  int power(int a, double exponent) { return curvature_.graph.power(a, exponent); }
  Entry entry(const std::string& name, int g) {
    return {name,
            {curvature_.graph, g},
            {curvature_.graph, curvature_.times(g, plus(curvature_.energy, -energy_at_start_))}};
  }

  double energy_at_start_;
  Curvature curvature_;
  OrbitScales scales_;
  int curvature_node_;
};

/// An orbit, its scales, and the menu.
struct Menu {
  using Entry = Monitors::Entry;  ///< A monitor of the menu.

  /// For this orbit.
  explicit Menu(const Orbit& of) : orbit(of) {
    try {
      Monitors make(orbit);
      entries = {
          make.fixed(),     make.energy("energy", 1.0),     make.speed(), make.energy("energy^1.5", 1.5),
          make.curvature(), make.energy("energy^0.5", 0.5), make.gentle()};
      scales = make.scales();
    } catch (const std::invalid_argument& reason) {
      ExpressionGraph graph(2 * static_cast<int>(orbit.start.q.size()));
      entries = {{"fixed", {graph, graph.constant(1.0)}, orbit.energy}};
      note = reason.what();
    }
  }

  Orbit orbit;                        ///< With H as a formula.
  std::optional<OrbitScales> scales;  ///< The scales of the orbit, where there are any.
  std::vector<Entry> entries;         ///< The monitors, fixed first.
  std::string note;                   ///< Why there is only one, or empty.
};

/// What a sweep costs, in additions of all its stages: the gradient of the transformed H, and the sums over
/// the stages (fitted to measured times).
inline double sweep_work(const Formula& transformed, int order) {
  const int lanes = order <= 8 ? 4 : 8;
  return 3.0 + 0.85 * static_cast<double>((transformed.inputs() / 2)) * lanes + transformed.work(lanes);
}

/// Length of the trials in radians, see OrbitScales::time_of().
inline constexpr double pilot_angle = 10.0;

/// The choice from a menu: each monitor is tried once with the same number of steps; then always the one that
/// promises the least product of work and steps, until the step of that one is found.
inline MonitorChoice choose(const Menu& menu, const MonitorTarget& target) {
  const std::optional<OrbitScales>& scales = menu.scales;
  MonitorChoice choice{
      .name = "fixed",
      .monitor = menu.entries.front().monitor,
      .order = target.order,
      .energy_scale = std::max(1e-300, scales ? scales->kinetic : std::abs(menu.orbit.energy_at_start())),
      .time = target.time > 0.0 ? target.time
              : scales          ? scales->time_of(pilot_angle)
                                : 1.0,
      .trials = {},
      .note = menu.note};
  const double radians = !scales ? 20.0 : target.time > 0.0 ? scales->frequency * choice.time : pilot_angle;
  const double first = radians * std::max(0.4, 0.15 * std::pow(target.energy_error, -1.0 / target.order));
  const double least =
      0.4 * radians;  // fewer steps do not resolve the motion, even where the energy error is small
  const long most = static_cast<long>(100.0 * first) + 1000;
  if (scales)
    choice.work = static_cast<double>(scales->evaluations) * menu.entries.front().transformed.work(1);
  const Pilot::Setting setting{menu.orbit, target.order, target.energy_error, choice.energy_scale,
                               menu.orbit.start.t + choice.time};
  struct Candidate {
    const Menu::Entry* entry;
    double sweep;
    OrbitScales::MonitorRange range;
    std::unique_ptr<Pilot> pilot;  // pilots do not move: their packs are aligned
    /// What its steps would cost if the longest step in n_0^(1/4) decided.
    [[nodiscard]] double outlook() const { return sweep * range.unevenness; }
  };
  const auto try_step = [&](Candidate& it, double h, double dearest) {
    choice.trials.push_back(it.pilot->trial(h, most, dearest));
    choice.sweeps += choice.trials.back().sweeps;
    choice.work += static_cast<double>(choice.trials.back().sweeps) * it.sweep;
  };
  std::vector<Candidate> candidates;  // fixed steps first
  for (const Menu::Entry& entry : menu.entries) {
    Candidate it{&entry, sweep_work(entry.transformed, target.order),
                 scales ? scales->range(entry.monitor) : OrbitScales::MonitorRange{.low = 1.0, .high = 1.0},
                 nullptr};
    // Not those that are not positive on the way, or hardly different from none; or so dear that no steps can
    // make up for it (measured: steps save at most some six tenths of what they could).
    if (candidates.empty() || (it.range.low > 0.0 && it.range.high > 1.15 * it.range.low &&
                               it.sweep <= 0.6 * candidates.front().outlook()))
      candidates.push_back(std::move(it));
  }
  // The most promising one first: the others then are given up early.
  std::ranges::stable_sort(candidates, {}, &Candidate::outlook);
  // What promises little is not tried, fixed steps only where all else fails.
  const double poor = 12.0 * candidates.front().outlook();
  const Pilot* fixed = nullptr;
  double best = std::numeric_limits<double>::infinity();
  for (Candidate& it : candidates) {
    const bool is_fixed = it.entry == &menu.entries.front(), promising = it.outlook() <= poor;
    // Weak candidates are not tested any more once the trials have cost five times the best one, about 8 % of
    // a run of 100 periods.
    const bool spent = choice.work > 5.0 * best && it.outlook() > 1.5 * candidates.front().outlook();
    // At best it takes five sweeps for each of the first steps.
    if (!is_fixed && (!promising || spent || 5.0 * it.sweep * first > best)) continue;
    const double fictive = scales ? scales->fictive_time(it.entry->monitor, choice.time) : choice.time;
    if (!(fictive > 0.0) || !std::isfinite(fictive)) continue;
    it.pilot = std::make_unique<Pilot>(setting, it.entry->name, it.entry->monitor, it.sweep, fictive,
                                       fictive / least, fictive / first / it.range.unevenness);
    if (is_fixed) fixed = it.pilot.get();
    if (promising) try_step(it, fictive / first, 2.0 * best);
    if (it.pilot->passed()) best = std::min(best, it.pilot->cost());
  }
  std::erase_if(candidates, [](const Candidate& it) { return !it.pilot; });
  for (int trials = 0; fixed && trials < 40; ++trials) {
    // The least product of work and steps, but no more work than fixed steps take.
    const double limit = fixed->cost();
    const auto price = [&](const Candidate& it) {
      const double work = it.pilot->cost();
      return work > limit ? std::numeric_limits<double>::infinity() : work * it.pilot->steps();
    };
    Candidate& lead = *std::ranges::min_element(candidates, {}, price);
    if (lead.pilot->done()) {
      choice.name = lead.entry->name;
      choice.monitor = lead.entry->monitor;
      choice.h = lead.pilot->good();
      choice.reached = true;
      break;
    }
    if (!std::isfinite(lead.pilot->cost())) break;
    try_step(lead, lead.pilot->next(), std::numeric_limits<double>::infinity());
  }
  return choice;
}

/// The monitor of a menu that takes the least work of collocation for the energy error asked for, with the
/// step that reaches it, found in short runs from `start`. The menu is fixed:
///
/// | name | g |
/// | --- | --- |
/// | fixed | 1 |
/// | energy | \f$(\bar T + \frac12(H + H_0) - H(q, 0))^{-1}\f$ |
/// | energy^0.5, energy^1.5 | the same to the powers -1/2 and -3/2 |
/// | speed | \f$(1 + S/\bar S)^{-1/2}\f$ |
/// | curvature | automatic_monitor() |
/// | gentle | \f$\big((n_0 + (\bar\omega/4)^4)^{1/4} + \bar\omega\big)^{-1}\f$ |
///
/// with \f$n_0\f$ and \f$\bar\omega\f$ of automatic_monitor() and the squared speed in phase space
/// \f$S = \dot q^T K^{-1}\dot q + \dot p^T K\,\dot p/\bar\omega^2\f$, \f$\bar S\f$ its mean. The energy scale
/// is the mean of \f$\frac12\dot q^T K^{-1}\dot q\f$, the kinetic energy. The same input gives the same
/// choice. A trial ends when \f$\int n_0^{1/4}dt\f$ or the turn of the velocity in phase space is 10.
///
/// Where these monitors cannot be made for H, fixed steps are chosen, and MonitorChoice::note says why.
/// @throws std::invalid_argument where H is not finite at the start, or for a target out of range.
template <class H, int n>
MonitorChoice choose_monitor(const H& hamiltonian, const State<n>& start, const MonitorTarget& target = {}) {
  require_positive("Energy error", target.energy_error);
  require(target.order >= 2 && target.order <= 16 && target.order % 2 == 0, "Order", target.order,
          "even and in [2, 16]");
  require(std::isfinite(target.time) && target.time >= 0.0, "Time of the pilot", target.time,
          "finite and not negative");
  return choose(Menu({hamiltonian, start}), target);
}

}  // namespace experiment
