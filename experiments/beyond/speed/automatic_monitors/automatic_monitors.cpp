#include "beyond/speed/automatic_monitors/families.hpp"
#include "beyond/speed/automatic_monitors/promises.hpp"
#include "common/frame.hpp"
#include "common/timing.hpp"

#include "avi/automatic/solution.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

// Steps of collocation for fixed errors of position and energy: monitors found from H alone, and chosen by a
// pilot run, against the best of those made by hand, fixed steps and the arclength.

namespace {

using namespace experiment;
using Point = avi::State<avi::dynamic>;

constexpr double infinity = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();

struct Targets {
  int order;
  double position, energy;
};
constexpr Targets all_targets[] = {{4, 1e-4, 1e-5}, {8, 1e-7, 1e-8}, {16, 1e-10, 1e-11}};

/// Steps to a target, and what the run that reached it was like.
struct Reached {
  double steps = nan, seconds = nan, position_error = nan, energy_error = nan;
};
struct Cost {
  Reached position, energy;
  /// Of both targets; infinite where one was not reached.
  [[nodiscard]] double mean() const {
    const double product = position.steps * energy.steps;
    return std::isnan(product) ? infinity : std::sqrt(product);
  }
};

/// A scene with what all its runs share.
struct Arena {
  const Scene& scene;
  const avi::detail::Menu menu;
  const avi::VectorX end;  ///< Position at the end.
  double scale;            ///< Of energy errors.
};

/// The position at the end by order 16 with steps of six tenths of those for an energy error of 1e-12.
avi::VectorX end_of(const Scene& scene, const avi::MonitorChoice& choice) {
  auto method = avi::collocation(poincare(scene.energy, scene.start, choice.monitor), 16);
  Point z = scene.start;
  (void)integrate_to(method, z, 0.6 * choice.h, scene.time);
  return z.q;
}

/// One run with about `steps` steps.
struct Measured {
  double steps, seconds, position_error, energy_error;
  bool ok;
};
Measured measure(const Arena& arena, avi::Collocation<avi::detail::Pilot::Problem>& method, double h,
                 long cap) {
  const avi::PhaseFunction& energy = arena.scene.energy;
  const double h0 = energy(arena.scene.start.q, arena.scene.start.p);
  Point z = arena.scene.start;
  double worst = 0.0;
  avi::Run run;
  const double time = seconds([&] {
    run = integrate_to(method, z, h, arena.scene.time, [&](const Point& at, long k) {
      worst = std::max(worst, std::abs(energy(at.q, at.p) - h0) / arena.scale);
      return k < cap && worst < 1e3;
    });
  });
  return {static_cast<double>(run.steps), time, (z.q - arena.end).norm(), worst,
          run.outcome == avi::Outcome::ok};
}

/// More and more steps until both targets are met, or more than `most` of them; between two runs the steps
/// for a target are interpolated.
Cost cost(const Arena& arena, const avi::PhaseFunction& monitor, const Targets& targets, double most,
          double factor) {
  Cost found;
  const avi::detail::Tour& tour = *arena.menu.tour();
  const double fictive = tour.fictive_time(monitor, arena.scene.time);
  if (!(fictive > 0.0) || !std::isfinite(fictive)) return found;
  auto method = avi::collocation(poincare(arena.scene.energy, arena.scene.start, monitor), targets.order);
  std::optional<Measured> before;
  const double radians = tour.frequency * arena.scene.time;
  for (double steps = 0.06 * radians * std::pow(targets.energy, -1.0 / targets.order); steps < 1.3 * most;
       steps *= factor) {
    const Measured now = measure(arena, method, fictive / steps, static_cast<long>(2.0 * most) + 50);
    if (now.ok && now.steps > most) break;
    if (!now.ok) {
      before.reset();
      continue;
    }
    const auto look = [&](Reached& reached, double target, double error, double error_before) {
      if (!std::isnan(reached.steps) || !(error <= target)) return;
      double at = now.steps;
      if (before && error_before > target && error > 0.0)
        at = before->steps * std::pow(now.steps / before->steps,
                                      std::log(error_before / target) / std::log(error_before / error));
      reached = {at, now.seconds * at / now.steps, now.position_error, now.energy_error};
    };
    look(found.position, targets.position, now.position_error, before ? before->position_error : nan);
    look(found.energy, targets.energy, now.energy_error, before ? before->energy_error : nan);
    before = now;
    if (std::isfinite(found.mean())) break;
  }
  return found;
}

/// Shares of problems within a factor of the best.
struct Share {
  int within_15 = 0, within_2 = 0, all = 0;
  void add(double ratio) {
    ++all;
    within_15 += ratio <= 1.5;
    within_2 += ratio <= 2.0;
  }
};

void add_rows(Table& table, const Scene& scene, const Targets& targets, const std::string& name,
              const Cost& cost, double best) {
  const double ratio = std::isfinite(cost.mean()) ? cost.mean() / best : nan;
  const auto row = [&](const char* target, const Reached& r) {
    table.row(scene.name, scene.held_out ? 1 : 0, targets.order, target, name, r.steps, r.seconds,
              r.position_error, r.energy_error, ratio);
  };
  row("position", cost.position);
  row("energy", cost.energy);
}

/// All monitors of a scene at an order; the ratio of the chosen one.
double compare(Table& table, Table& choices, const Arena& arena, const Targets& targets, double factor) {
  const Scene& scene = arena.scene;
  std::vector<HandMade> hand_made = scene.hand_made;
  const avi::PhaseFunction& fixed = std::next(arena.menu.entries().begin())->monitor;
  hand_made.push_back({"arclength", Slopes(scene.energy).arclength(0.5)});
  hand_made.push_back({"none", fixed});
  for (HandMade& family : scanned_families(scene))
    hand_made.push_back(std::move(family));
  Cost best;
  std::string best_name;
  for (const HandMade& made : hand_made) {
    const Cost it = cost(arena, made.monitor, targets, std::min(1.05 * best.mean(), 15000.0), factor);
    if (it.mean() < best.mean()) {
      best = it;
      best_name = made.name;
    }
  }
  const double most = std::min(6.0 * best.mean(), 15000.0);
  add_rows(table, scene, targets, "best:" + best_name, best, best.mean());
  add_rows(table, scene, targets, "none", cost(arena, fixed, targets, most, factor), best.mean());
  add_rows(table, scene, targets, "arclength",
           cost(arena, Slopes(scene.energy).arclength(0.5), targets, most, factor), best.mean());
  const Cost automatic = cost(arena, arena.menu.entries().front().monitor, targets, most, factor);
  add_rows(table, scene, targets, "automatic", automatic, best.mean());
  const avi::MonitorChoice choice =
      choose_monitor(scene.energy, scene.start, {.energy_error = targets.energy, .order = targets.order});
  const Cost chosen = cost(arena, choice.monitor, targets, most, factor);
  add_rows(table, scene, targets, "chosen", chosen, best.mean());
  choices.row(scene.name, scene.held_out ? 1 : 0, targets.order, choice.name, choice.sweeps, choice.time,
              automatic.mean() / best.mean(), chosen.mean() / best.mean(), best_name);
  return chosen.mean() / best.mean();
}

}  // namespace

int main(int argc, char** argv) {
  bool full = false;
  return run(
      argc, argv, "automatic_monitors", "Monitors found from H alone against the best made by hand",
      [&](CLI::App& app) {
        add_flag(app, "--full", full,
                 "A finer grid of step sizes, and drift over a thousand times the horizon");
      },
      [&](Frame& frame) {
        Table table = frame.table({"problem", "held_out", "order", "target", "monitor", "steps", "seconds",
                                   "position_error", "energy_error", "ratio_to_best"});
        Table choices = frame.table({"problem", "held_out", "order", "choice", "pilot_sweeps", "pilot_time",
                                     "automatic_ratio", "chosen_ratio", "best"});
        std::vector<Scene> scenes = celestial_scenes();
        for (auto* more : {&other_scenes, &further_scenes, &held_out_scenes})
          for (Scene& scene : more())
            scenes.push_back(std::move(scene));
        if (frame.quick)
          std::erase_if(scenes, [](const Scene& s) {
            return s.name != "kepler_0.9" && s.name != "lennard_jones" && s.name != "separatrix" &&
                   s.name != "henon_heiles" && s.name != "yukawa";
          });
        std::map<std::pair<bool, int>, Share> shares;
        double done = 0.0;
        for (const Scene& scene : scenes) {
          frame.progress(scene.name, done++ / static_cast<double>(scenes.size()));
          const auto exact = integrate(scene.energy, scene.start, scene.time, 1e-12);
          const Arena arena{scene, avi::detail::Menu(scene.energy, scene.start), end_of(scene, exact.choice),
                            exact.choice.energy_scale};
          for (const Targets& targets : all_targets)
            shares[{scene.held_out, targets.order}].add(
                compare(table, choices, arena, targets, full ? 1.12 : 1.4));
        }
        Table summary = frame.table({"held_out", "order", "problems", "within_1.5", "within_2"});
        for (const auto& [key, share] : shares) {
          summary.row(key.first ? 1 : 0, key.second, share.all, share.within_15, share.within_2);
          fmt::print("{} order {:2}: chosen within 1.5 of the best on {} of {}, within 2 on {}\n",
                     key.first ? "held out" : "tuned   ", key.second, share.within_15, share.all,
                     share.within_2);
        }
        measure_tolerances(frame, scenes);
        measure_drift(frame, scenes, frame.quick ? 10 : full ? 1000 : 30);
        frame.write(table);
        frame.write(choices, "choices");
        frame.write(summary, "summary");
      });
}
