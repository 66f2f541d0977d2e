#include "beyond/speed/automatic_monitors/cost.hpp"
#include "beyond/speed/automatic_monitors/families.hpp"
#include "beyond/speed/automatic_monitors/promises.hpp"
#include "common/frame.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

// Steps of collocation for fixed errors of position and energy: monitors found from H alone, and chosen by a
// pilot run, against the best of those made by hand, fixed steps and the arclength.

namespace {

using namespace experiment;
constexpr Targets all_targets[] = {{4, 1e-4, 1e-5}, {8, 1e-7, 1e-8}, {16, 1e-10, 1e-11}};

/// Shares of problems within a factor of the best, in steps and in work.
struct Share {
  int within_15 = 0, within_2 = 0, work_within_15 = 0, work_within_2 = 0, all = 0, plain = 0,
      plain_slower = 0, dear = 0;
};

/// What a scene showed at one order.
struct Verdict {
  double steps, work, against_fixed, pilot;
  bool plain;  ///< No monitor made by hand saves a tenth of the work of fixed steps.
};

/// All monitors of a scene at an order.
Verdict compare(Table& table, Table& choices, const Arena& arena, const Targets& targets, double factor) {
  const Scene& scene = arena.scene;
  const avi::PhaseFunction& fixed = arena.menu.entries().front().monitor;
  std::vector<HandMade> hand_made = scene.hand_made;
  hand_made.push_back({"arclength", Slopes(scene.energy).arclength(0.5)});
  for (HandMade& family : scanned_families(scene))
    hand_made.push_back(std::move(family));
  const auto reach = [&](const avi::PhaseFunction& monitor, double most, double dearest) {
    return cost(arena, monitor, targets, most, dearest, factor);
  };
  const Cost none = reach(fixed, infinity, infinity);
  Cost best = none, cheapest = none;
  std::string best_name = "none", cheapest_name = "none";
  for (const HandMade& made : hand_made) {
    const Cost it = reach(made.monitor, 1.05 * best.steps(), 1.05 * cheapest.work());
    if (it.steps() < best.steps()) best = it, best_name = made.name;
    if (it.work() < cheapest.work()) cheapest = it, cheapest_name = made.name;
  }
  const auto rows = [&](const std::string& name, const Cost& it) {
    const auto ratio = [](double a, double b) { return std::isfinite(a) ? a / b : unknown; };
    const auto row = [&](const char* target, const Reached& r) {
      table.row(scene.name, scene.held_out ? 1 : 0, targets.order, target, name, r.steps, r.seconds,
                r.position_error, r.energy_error, ratio(it.steps(), best.steps()), r.sweeps,
                r.sweeps * it.sweep, ratio(it.work(), cheapest.work()));
    };
    row("position", it.position);
    row("energy", it.energy);
  };
  const double most = 6.0 * best.steps(), dearest = 6.0 * cheapest.work();
  rows("best:" + best_name, best);
  rows("cheapest:" + cheapest_name, cheapest);
  rows("none", none);
  rows("arclength", reach(Slopes(scene.energy).arclength(0.5), most, dearest));
  const Cost automatic = reach(automatic_monitor(scene.energy, scene.start), most, dearest);
  rows("automatic", automatic);
  std::optional<avi::MonitorChoice> chosen_by;
  const double pilot_seconds = seconds([&] {
    chosen_by =
        choose_monitor(scene.energy, scene.start, {.energy_error = targets.energy, .order = targets.order});
  });
  const avi::MonitorChoice& choice = *chosen_by;
  const Cost chosen = choice.reached ? reach(choice.monitor, most, dearest) : Cost();
  rows("chosen", chosen);
  // The pilot against ten horizons, and against a hundred turns.
  auto method = avi::collocation(poincare(scene.energy, scene.start, choice.monitor), targets.order);
  Point z = scene.start;
  avi::Run run;
  const double run_seconds = 10.0 * seconds([&] {
                               if (choice.reached)
                                 run = integrate(method, z, choice.h, avi::Until{.time = scene.time});
                             });
  const double run_work = 10.0 * chosen.sweep * static_cast<double>(run.evaluations);
  const Verdict verdict{chosen.steps() / best.steps(), chosen.work() / cheapest.work(),
                        chosen.work() / none.work(), choice.work / run_work * arena.turns / 10.0,
                        cheapest.work() > 0.9 * none.work()};
  choices.row(scene.name, scene.held_out ? 1 : 0, targets.order, choice.name, choice.sweeps, choice.time,
              automatic.steps() / best.steps(), verdict.steps, best_name, automatic.work() / cheapest.work(),
              verdict.work, cheapest_name, none.steps() / best.steps(), none.work() / cheapest.work(),
              choice.work / run_work, pilot_seconds, run_seconds, arena.turns, verdict.pilot);
  return verdict;
}

}  // namespace

int main(int argc, char** argv) {
  bool extremes = false;
  return run(
      argc, argv, "automatic_monitors", "Monitors found from H alone against the best made by hand",
      [&](CLI::App& app) {
        add_flag(app, "--extremes", extremes, "Drift over a thousand horizons, ten thousand periods");
      },
      [&](Frame& frame) {
        Table table =
            frame.table({"problem", "held_out", "order", "target", "monitor", "steps", "seconds",
                         "position_error", "energy_error", "ratio_to_best", "sweeps", "work", "work_ratio"});
        Table choices =
            frame.table({"problem", "held_out", "order", "choice", "pilot_sweeps", "pilot_time",
                         "automatic_ratio", "chosen_ratio", "best", "automatic_work_ratio",
                         "chosen_work_ratio", "cheapest", "none_ratio", "none_work_ratio", "pilot_share",
                         "pilot_seconds", "run_seconds", "turns", "pilot_share_of_100"});
        for (Table* each : {&table, &choices})
          each->note("seconds", "other experiments may run beside this one; work is what is compared");
        std::vector<Scene> scenes = celestial_scenes();
        for (auto* more : {&other_scenes, &further_scenes, &drawn_scenes, &held_out_scenes})
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
          const avi::MonitorChoice exact = finest(scene);
          if (!exact.reached) {  // counts as lost at every order
            fmt::print("{}: no choice reached an energy error\n{}", scene.name, exact.report());
            for (const Targets& targets : all_targets)
              ++shares[{scene.held_out, targets.order}].all;
            continue;
          }
          const Arena arena = arena_of(scene, exact);
          for (const Targets& targets : all_targets) {
            const Verdict v = compare(table, choices, arena, targets, 1.4);
            Share& share = shares[{scene.held_out, targets.order}];
            ++share.all;
            share.within_15 += v.steps <= 1.5;
            share.within_2 += v.steps <= 2.0;
            share.work_within_15 += v.work <= 1.5;
            share.work_within_2 += v.work <= 2.0;
            share.plain += v.plain;
            share.plain_slower += v.plain && v.against_fixed > 1.1;
            share.dear += v.pilot > 0.15;
          }
        }
        Table summary =
            frame.table({"held_out", "order", "problems", "within_1.5", "within_2", "work_within_1.5",
                         "work_within_2", "plain", "plain_slower", "pilot_over_15"});
        for (const auto& [key, share] : shares) {
          summary.row(key.first ? 1 : 0, key.second, share.all, share.within_15, share.within_2,
                      share.work_within_15, share.work_within_2, share.plain, share.plain_slower, share.dear);
          fmt::print(
              "{} order {:2}, {} problems: work within 1.5 of the best by hand on {}, within 2 on {} (steps: "
              "{}, {}); where none is needed ({}) over a tenth slower on {}; pilot above 15 % of a hundred "
              "turns on {}\n",
              key.first ? "held out" : "tuned   ", key.second, share.all, share.work_within_15,
              share.work_within_2, share.within_15, share.within_2, share.plain, share.plain_slower,
              share.dear);
        }
        measure_tolerances(frame, scenes);
        measure_drift(frame, scenes, frame.quick || extremes ? 1000 : 20);
        frame.write(table);
        frame.write(choices, "choices");
        frame.write(summary, "summary");
      });
}
