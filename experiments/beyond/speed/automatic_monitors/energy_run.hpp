#pragma once
#include "avi/core/integrate_to.hpp"
#include "beyond/speed/automatic_monitors/choose_monitor.hpp"

#include <sstream>

/// @file
/// A run whose monitor and step are chosen by its energy error: what the monitors are compared by.

namespace experiment {

using avi::Collocation, avi::Outcome, avi::Run, avi::State, avi::dynamic;

/// Where an orbit led, how, and how well.
template <int n>
struct EnergyRun {
  State<n> state;             ///< At the end, or the last good one.
  Run run;                    ///< How the run ended; its steps and sweeps.
  MonitorChoice choice;       ///< Monitor, order and step, with what the pilot saw.
  double tolerance = 0.0;     ///< Asked for.
  double energy_error = 0.0;  ///< Largest |H - H_0| of the run, over choice.energy_scale.

  /// The energy error is at most ten times the tolerance.
  [[nodiscard]] bool kept() const { return energy_error <= 10.0 * tolerance; }

  /// What was chosen, why, and what came of it.
  [[nodiscard]] std::string report() const {
    std::ostringstream text;
    text.precision(3);
    text << choice.report();
    if (run.outcome != Outcome::ok) text << run.message << "\n";
    if (run.steps > 0) {
      text << run.steps << " steps, " << run.evaluations << " sweeps; largest energy error " << energy_error
           << " of the energy scale " << choice.energy_scale << ", tolerance " << tolerance << ".\n";
      if (!kept())
        text << "The energy error is more than ten times the tolerance: later parts of the orbit are harder "
                "than the pilot's; ask for a smaller tolerance.\n";
    }
    return text.str();
  }
};

namespace detail {
/// The order that takes the least work at an energy error: 4, 8 or 16.
inline int order_for(double tolerance) { return tolerance > 3e-6 ? 4 : tolerance > 3e-10 ? 8 : 16; }

/// How often a run may be repeated with a shorter step.
inline constexpr int most_restarts = 6;

/// The part of integrate(H, start, t_end, tolerance) that depends neither on the type of H nor on its
/// dimension.
inline EnergyRun<dynamic> solve(const Menu& menu, double t_end, double tolerance) {
  EnergyRun<dynamic> solution{
      .state = menu.orbit.start,
      .run = {},
      .choice = {.name = "fixed", .monitor = menu.entries.front().monitor, .trials = {}, .note = {}},
      .tolerance = tolerance};
  const double span = t_end - menu.orbit.start.t;
  if (span == 0.0) return solution;
  // 0: of its usual length
  const double pilot = !menu.scales ? 0.1 * span : span < menu.scales->time_of(pilot_angle) ? span : 0.0;
  solution.choice = choose(menu, {.energy_error = tolerance, .order = order_for(tolerance), .time = pilot});
  MonitorChoice& choice = solution.choice;
  if (!choice.reached) {
    solution.run.outcome = Outcome::not_converged;
    solution.run.message =
        "No monitor and step of the pilot reached the tolerance: the orbit may meet a singularity "
        "of H, or the tolerance may be below rounding.";
    return solution;
  }
  Collocation<Pilot::Problem> whole(avi::poincare(menu.orbit.energy, menu.orbit.start, choice.monitor),
                                    choice.order);
  const double energy = menu.orbit.energy_at_start();
  for (int restarts = 0;; ++restarts) {
    solution.state = menu.orbit.start;
    solution.energy_error = 0.0;
    solution.run =
        avi::integrate_to(whole, solution.state, choice.h, t_end, [&](const State<dynamic>& z, long) {
          const double error = std::abs(menu.orbit.energy(z.q, z.p) - energy) / choice.energy_scale;
          solution.energy_error = std::max(solution.energy_error, error);
          return restarts == most_restarts || error <= 3.0 * tolerance;
        });
    const bool converged =
        solution.run.outcome != Outcome::not_converged && solution.run.outcome != Outcome::non_finite;
    if (restarts == most_restarts || (converged && solution.energy_error <= 3.0 * tolerance)) break;
    // The orbit is harder here than where the pilot was. A step that changes on the way would not be
    // symplectic, so the whole run is repeated with a shorter one.
    choice.trials.push_back({choice.name, choice.h, solution.run.steps, solution.run.evaluations,
                             solution.energy_error, solution.run.outcome});
    choice.sweeps += solution.run.evaluations;
    choice.h *= converged ? std::clamp(std::pow(0.6 * tolerance / solution.energy_error, 1.0 / choice.order),
                                       0.5, 0.96)
                          : 0.7;
  }
  return solution;
}
}  // namespace detail

/// Integrates the orbit of H from `start` to the physical time `t_end` such that its energy error, relative
/// to choice.energy_scale, is about `tolerance`. Order, monitor and step come from a pilot run, see
/// choose_monitor(); then they are frozen, and the run is Gauss collocation with constant steps in fictive
/// time, symplectic but for the last, shorter step that ends at t_end. Failures are outcomes; report() says
/// everything in words.
/// @throws std::invalid_argument where H is not finite at the start, or for a time or tolerance out of range.
template <class H, int n>
[[nodiscard]] EnergyRun<n> energy_run(const H& hamiltonian, const State<n>& start, double t_end,
                                      double tolerance) {
  avi::require_finite("Time of the start", start.t);
  avi::require(std::isfinite(t_end) && t_end >= start.t, "End time", t_end,
               "finite and not before the start");
  avi::require(tolerance >= 1e-13 && tolerance <= 1e-2, "Tolerance", tolerance, "in [1e-13, 1e-2]");
  EnergyRun<dynamic> found = detail::solve(Menu({hamiltonian, start}), t_end, tolerance);
  return {.state = {.q = found.state.q, .p = found.state.p, .t = found.state.t},
          .run = std::move(found.run),
          .choice = std::move(found.choice),
          .tolerance = found.tolerance,
          .energy_error = found.energy_error};
}

}  // namespace experiment
