#include "beyond/speed/automatic_monitors/drift.hpp"

#include <fmt/format.h>

#include <map>

// Steps of collocation for given errors of position and energy: the monitors that solve() chooses from H
// alone, compared with the best hand-made ones, with fixed steps and with the arclength.

namespace {

using namespace experiment;
constexpr Targets all_targets[] = {{4, 1e-4, 1e-5}, {8, 1e-7, 1e-8}, {16, 1e-10, 1e-11}};

/// General monitors: the arclength of phase space, \f$(|\dot q|^2 + |\dot p|^2)^{-1/2}\f$; the paper's energy
/// monitor, \f$(p\cdot\partial H/\partial p + c)^{-\alpha}\f$ (twice the kinetic energy), and its inverse
/// Lagrangian, \f$(L^2 + c)^{-\alpha}\f$, each with floors c and exponents that one would scan; and the
/// arclength with other exponents.
std::vector<HandMade> general_monitors(const Scene& scene) {
  const int n = scene.energy.inputs() / 2;
  const avi::Recording recording(scene.energy);
  avi::ExpressionGraph graph = recording.graph();
  const V q = avi::recorded_inputs(graph, 0, n), p = avi::recorded_inputs(graph, n, n);
  const Recorded energy = scene.energy(q, p);
  const auto slope = [&](int i) { return Recorded(graph, recording.slope(i)); };  // dH/dq, dH/dp
  Recorded squared_speed = 0.0, work = 0.0;
  for (int i = 0; i < 2 * n; ++i)
    squared_speed += square(slope(i));
  for (int i = 0; i < n; ++i)
    work += p[i] * slope(n + i);

  std::vector<HandMade> made;
  const auto add = [&](const char* name, const Recorded& base, double alpha) {
    made.push_back({name, {graph, pow(base, -alpha).node_in(graph)}});
  };
  const double h0 = scene.energy(scene.start.q, scene.start.p);
  add("arclength", squared_speed, 0.5);
  for (const double alpha : {0.5, 1.0, 1.5})
    for (const double floor : {0.1, 1.0})
      add("energy", work + floor * std::max(0.1, std::abs(h0)), alpha);
  for (const double alpha : {0.5, 0.75})
    add("inverse_lagrangian", square(work - energy) + (h0 * h0 + 0.01), alpha);
  add("arclength^0.5", squared_speed, 0.25);
  add("arclength^1.5", squared_speed, 0.75);
  return made;
}

/// Compares all monitors for a scene and an order. @return true if the choice of solve() takes at most twice
/// the least work of fixed steps and of the hand-made monitors
bool compare(Table& table, Table& choices, const Arena& arena, const Targets& targets) {
  const Scene& scene = arena.scene;
  const avi::Formula fixed = monitor_of(scene, {});
  std::vector<HandMade> hand_made = general_monitors(scene);
  hand_made.insert(hand_made.begin(), scene.hand_made.begin(), scene.hand_made.end());
  const Cost none = cost(arena, fixed, targets, HUGE_VAL, HUGE_VAL);
  Cost best = none, cheapest = none;
  std::string best_name = "none";
  for (const HandMade& made : hand_made) {
    const Cost it = cost(arena, made.monitor, targets, 1.05 * best.steps(), 1.05 * cheapest.work());
    if (it.steps() < best.steps()) best = it, best_name = made.name;
    if (it.work() < cheapest.work()) cheapest = it;
  }
  const double most = 6.0 * best.steps(), dearest = 6.0 * cheapest.work();
  const avi::SolutionReport solution = choose(scene, 10.0 * scene.time, targets.position, targets.order);
  const Cost chosen =
      solution.ok() ? cost(arena, monitor_of(scene, solution.choice), targets, most, dearest) : Cost();
  for (const auto& [target, run] : {std::pair{"position", chosen.position}, {"energy", chosen.energy}})
    table.row(scene.name, scene.held_out, targets.order, target, run.steps, run.position_error,
              run.energy_error, run.sweeps, run.sweeps * chosen.sweep);
  const double steps = chosen.steps() / best.steps(), work = chosen.work() / cheapest.work();
  const double choosing = static_cast<double>(solution.choice.sweeps) / solution.run.evaluations;
  choices.row(scene.name, scene.held_out, targets.order, solution.choice.name, steps, best_name, work,
              none.work() / cheapest.work(), choosing);
  return work <= 2.0;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"problem", "held_out", "order", "target", "steps", "position_error",
                              "energy_error", "sweeps", "work"});
  Table& choices = frame.table("choices", {"problem", "held_out", "order", "choice", "chosen_ratio", "best",
                                           "chosen_work_ratio", "none_work_ratio", "choosing_share"});
  table.note("steps", "with the monitor that solve() chooses");
  Scenes scenes;
  for (const auto& add : {add_celestial, add_first, add_further, add_seen, add_held_out})
    add(scenes);
  if (frame.quick)
    std::erase_if(scenes, [](const Scene& s) {
      return s.name != "kepler_0.9" && s.name != "lennard_jones" && s.name != "separatrix" &&
             s.name != "henon_heiles" && s.name != "yukawa";
    });
  struct Count {
    int problems = 0, within_2 = 0;
  };
  std::map<std::pair<bool, int>, Count> counts;
  double done = 0.0;
  for (const Scene& scene : scenes) {
    frame.progress(scene.name, done++, scenes.size());
    const Arena arena = arena_of(scene);
    if (arena.orbit.empty()) fmt::print("{}: no run kept a tolerance\n", scene.name);
    for (const Targets& targets : all_targets) {
      Count& count = counts[{scene.held_out, targets.order}];
      ++count.problems;  // a scene without an orbit counts as lost
      count.within_2 += !arena.orbit.empty() && compare(table, choices, arena, targets);
    }
  }
  Table& summary = frame.table("summary", {"held_out", "order", "problems", "work_within_2"});
  for (const auto& [key, count] : counts)
    summary.row(key.first, key.second, count.problems, count.within_2);
  measure_drift(frame, scenes, frame.quick || frame.longer ? 1000 : 20);
}
