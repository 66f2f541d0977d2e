#pragma once
#include "avi/automatic/automatic_monitor.hpp"
#include "avi/automatic/pilot.hpp"

#include <memory>
#include <optional>

/// @file
/// A monitor chosen from a menu by a short run.

namespace avi {

/// What a pilot run is to reach.
struct MonitorTarget {
  double energy_error = 1e-8;  ///< Largest |H - H_0|, relative to the energy scale of choose_monitor().
  int order = 8;               ///< Of the collocation method.
  double time = 0.0;           ///< Length of the trials; 0 takes 10 mean radians of the fastest motion.
};

namespace detail {

/// H as a formula, its scales, and the menu.
class Menu {
 public:
  using Point = State<dynamic>;  ///< Of any dimension.
  /// A monitor of the menu.
  struct Entry {
    std::string name;
    PhaseFunction monitor;
  };

  /// For the orbit of H through `start`.
  template <class H, int n>
  Menu(const H& hamiltonian, const State<n>& start)
      : start_{.q = start.q, .p = start.p, .t = start.t},
        energy_(phase_function<n>(hamiltonian, start.q.size())) {
    if (!start_.finite() || !std::isfinite(energy_(start_.q, start_.p)))
      throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
    try {
      monitors_.emplace(hamiltonian, start);
    } catch (const std::invalid_argument& reason) {
      note_ = reason.what();
    }
    if (!monitors_) {
      entries_ = {{"fixed", constant()}};
      return;
    }
    entries_ = {{"curvature", monitors_->curvature()},
                {"fixed", constant()},
                {"gentle", monitors_->gentle()},
                {"speed", monitors_->speed(0.25, 0.0)},
                {"slow_speed", monitors_->speed(0.5, 1.0)}};
  }

  [[nodiscard]] const Point& start() const { return start_; }                   ///< Of the orbit.
  [[nodiscard]] const PhaseFunction& energy() const { return energy_; }         ///< H.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }  ///< The monitors.
  [[nodiscard]] const std::string& note() const { return note_; }  ///< Why there is only one, or empty.
  /// The scales of the orbit, where there are any.
  [[nodiscard]] const Tour* tour() const { return monitors_ ? &monitors_->tour() : nullptr; }

 private:
  [[nodiscard]] PhaseFunction constant() const {
    ExpressionGraph graph(2 * static_cast<int>(start_.q.size()));
    return {graph, graph.constant(1.0)};
  }

  Point start_;
  PhaseFunction energy_;
  std::optional<Monitors> monitors_;
  std::vector<Entry> entries_;
  std::string note_;
};

/// The choice from a menu: each monitor is tried once with the same number of steps; then, beginning with the
/// most promising one, the step of each that may still win is searched for.
inline MonitorChoice choose(const Menu& menu, const MonitorTarget& target) {
  const Tour* tour = menu.tour();
  const double start_energy = menu.energy()(menu.start().q, menu.start().p);
  MonitorChoice choice{.name = "fixed",
                       .monitor = menu.entries().front().monitor,
                       .order = target.order,
                       .energy_scale = tour ? tour->kinetic : std::max(1e-300, std::abs(start_energy)),
                       .time = target.time > 0.0 ? target.time
                               : tour            ? 10.0 / tour->frequency
                                                 : 1.0,
                       .trials = {},
                       .note = menu.note()};
  const double radians = tour ? tour->frequency * choice.time : 20.0, end = menu.start().t + choice.time;
  const double first = radians * std::max(0.4, 0.15 * std::pow(target.energy_error, -1.0 / target.order));
  struct Candidate {
    const Menu::Entry* entry;
    double fictive, promise;
    std::unique_ptr<Pilot> pilot;  // Pilots do not move: their packs are aligned
  };
  std::vector<Candidate> candidates;
  for (const Menu::Entry& entry : menu.entries()) {
    const double fictive = tour ? tour->fictive_time(entry.monitor, choice.time) : choice.time;
    if (!(fictive > 0.0) || !std::isfinite(fictive)) continue;
    candidates.push_back({&entry, fictive, 0.0,
                          std::make_unique<Pilot>(entry.name, menu.energy(), entry.monitor, menu.start(),
                                                  target.order, choice.energy_scale)});
    Candidate& it = candidates.back();
    const Trial trial = it.pilot->trial(fictive / first, end, static_cast<long>(4.0 * first) + 10, choice);
    it.promise = std::isfinite(trial.energy_error)
                     ? first * std::pow(trial.energy_error / target.energy_error + 1e-16, 1.0 / target.order)
                     : 1e300;
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.promise < b.promise; });
  double fewest = std::numeric_limits<double>::infinity();
  const double least =
      0.4 * radians;  // fewer steps do not resolve the motion, even where the energy error is small
  for (Candidate& it : candidates) {
    if (choice.reached && it.promise > 1.6 * fewest) continue;
    const double guess = choice.reached ? 0.9 * fewest : std::min(it.promise, 100.0 * first);
    const Pilot::Found found =
        it.pilot->search(it.fictive / std::max(least, guess), end, target.energy_error,
                         choice.reached ? fewest : 30.0 * first, it.fictive / least, choice);
    // A step without a monitor costs less.
    const double steps = std::max(least, found.steps) * (it.entry->name == "fixed" ? 0.85 : 1.0);
    if (!found.reached || !(steps < fewest)) continue;
    fewest = steps;
    choice.name = it.entry->name;
    choice.monitor = it.entry->monitor;
    choice.h = found.h;
    choice.reached = true;
  }
  return choice;
}

}  // namespace detail

/// The monitor of a menu that takes the fewest steps of collocation for the energy error asked for, with the
/// step that reaches it, found in short runs from `start`. The menu is fixed:
///
/// | name | g |
/// | --- | --- |
/// | curvature | automatic_monitor() |
/// | fixed | 1 |
/// | gentle | \f$\big((n_0 + (\bar\omega/4)^4)^{1/4} + \bar\omega\big)^{-1}\f$ |
/// | speed | \f$S^{-1/4}\f$ |
/// | slow_speed | \f$(S + \bar S)^{-1/2}\f$ |
///
/// with \f$n_0\f$ and \f$\bar\omega\f$ of automatic_monitor() and the squared speed in phase space
/// \f$S = \dot q^T K^{-1}\dot q + \dot p^T K\,\dot p/\bar\omega^2\f$, \f$\bar S\f$ its mean. The energy scale
/// is the mean of \f$\frac12\dot q^T K^{-1}\dot q\f$, the kinetic energy. The same input gives the same
/// choice.
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
  return detail::choose(detail::Menu(hamiltonian, start), target);
}

}  // namespace avi
