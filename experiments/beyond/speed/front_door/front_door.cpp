#include "beyond/speed/front_door/race.hpp"
#include "beyond/speed/front_door/scenes.hpp"
#include "beyond/speed/work_precision/peers/peers.hpp"

#include "common/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// avi::solve() as a user calls it against the integrators of other libraries: the time of the whole call at
// equal error of the position at the end.

namespace {

using namespace experiment;
using namespace experiment::front_door;

double ratio(const std::optional<Point>& ours, const std::optional<Point>& peer) {
  return ours && peer ? ours->seconds / peer->seconds : unknown;
}

/// What README and the figure say of all cells.
struct Summary {
  std::vector<double> ratios;  ///< Infinite where only a peer reaches the target.
  long behind = 0, cells = 0;
  double worst = 0.0;
  std::string worst_cell;

  void add(const std::string& label, double value) {
    ratios.push_back(value);
    ++cells;
    if (value > 1.0) ++behind;
    if (value > worst) worst = value, worst_cell = label;
  }
};

}  // namespace

int main(int argc, char** argv) {
  bool full = false, all = false;
  std::string only;
  const auto options = [&](CLI::App& app) {
    add_flag(app, "--full", full, "All scenes, finer tolerances, longer blocks, 1000 characteristic times");
    add_flag(app, "--all", all, "Held-out scenes, too");
    add_text(app, "--scene", only, "Only scenes whose name contains this, as `kepler`");
  };
  return run(argc, argv, AVI_SHOWS, options, [&](Frame& frame) {
    Budget budget;
    budget.longest_run = 0.005;
    if (full)
      budget = {.longest_run = 0.5, .least_block = 1e-3, .rounds = 7, .ratio = std::sqrt(0.1), .refined = 4};
    const double longest = full ? 1000.0 : frame.quick ? 10.0 : 100.0;
    Table table = frame.table({"scene", "kind", "held_out", "horizon", "method", "setting", "error",
                               "seconds", "steps", "evaluations"});
    Table cells = frame.table({"scene",
                               "kind",
                               "held_out",
                               "horizon",
                               "target",
                               "ours",
                               "ours_unchecked",
                               "best_peer",
                               "best_peer_name",
                               "ratio",
                               "ratio_unchecked",
                               "ours_evaluations",
                               "unchecked_evaluations",
                               "peer_evaluations",
                               "ours_setting",
                               "peer_setting",
                               "choosing_sweeps",
                               "check_sweeps",
                               "run_sweeps",
                               "monitor",
                               "order",
                               "steps"});
    table.note("peers", work_precision::peers_present());
    cells.note("peers", work_precision::peers_present());
    fmt::print("{:13} {:>5} {:>6} {:>9} {:>9} {:>9} {:>18} {:>7} {:>9}  {:>7} {:>8} {:>8} {:>8}  {}\n",
               "scene", "units", "error", "us", "us unchkd", "us peer", "peer", "ratio", "unchecked",
               "eval.s", "choosing", "check", "run", "tolerance, choice");
    Summary summary, unchecked;
    for (const Scene& scene : scenes()) {
      if ((scene.held_out && !full && !all) || scene.name.find(only) == std::string::npos) continue;
      for (const double horizon : scene.horizons) {
        if (horizon > longest) continue;
        const double span = horizon * scene.unit;
        const Contest contest = scene.make(span);
        if (contest.reference_error > 1e-12)
          cells.note(fmt::format("reference error of {} {:g}", scene.name, horizon),
                     rounded(contest.reference_error, 2));
        const Outcome outcome = race(contest, budget);
        for (const Point& p : outcome.points)
          table.row(scene.name, scene.kind, scene.held_out, horizon, contest.families[p.family].method,
                    rounded(p.setting, 4), rounded(p.error, 4), rounded(p.seconds, 4), p.steps,
                    p.evaluations);
        for (const Cell& cell : outcome.cells) {
          if (!cell.ours && !cell.unchecked && !cell.peer) continue;
          std::string choice;
          avi::SolutionReport report;
          if (cell.ours) {
            report = contest.call(cell.ours->setting, true);
            choice = fmt::format("{:.1e} {} {} h={:.3g}, {} steps, {} trials", cell.ours->setting,
                                 report.choice.name, report.choice.order, report.choice.h, report.run.steps,
                                 report.choice.trials.size());
          }
          const auto us = [](const std::optional<Point>& p) { return p ? 1e6 * p->seconds : unknown; };
          const auto counted = [](const std::optional<Point>& p) {
            return p ? static_cast<double>(p->evaluations) : unknown;
          };
          const double its = ratio(cell.ours, cell.peer), its_unchecked = ratio(cell.unchecked, cell.peer);
          const std::string peer = cell.peer ? contest.families[cell.peer->family].method : "none";
          fmt::print("{:13} {:5g} {:6.0e} {:9.4g} {:9.4g} {:9.4g} {:>18} {:7.2f} {:9.2f}  {:7.2f} {:8} {:8} "
                     "{:8}  {}\n",
                     scene.name, horizon, cell.target, us(cell.ours), us(cell.unchecked), us(cell.peer), peer,
                     its, its_unchecked, counted(cell.ours) / counted(cell.peer), report.choice.sweeps,
                     report.choice.check, report.run.evaluations, choice);
          std::fflush(stdout);
          cells.row(scene.name, scene.kind, scene.held_out, horizon, cell.target,
                    rounded(1e-6 * us(cell.ours), 4), rounded(1e-6 * us(cell.unchecked), 4),
                    rounded(1e-6 * us(cell.peer), 4), peer, rounded(its, 4), rounded(its_unchecked, 4),
                    counted(cell.ours), counted(cell.unchecked), counted(cell.peer),
                    rounded(cell.ours ? cell.ours->setting : unknown, 4),
                    rounded(cell.peer ? cell.peer->setting : unknown, 4), report.choice.sweeps,
                    report.choice.check, report.run.evaluations, cell.ours ? report.choice.name : "none",
                    report.choice.order, report.run.steps);
          const std::string label = fmt::format("{} {:g} {:.0e}", scene.name, horizon, cell.target);
          if (cell.peer && (cell.ours || !outcome.cut_short)) {
            summary.add(label, cell.ours ? its : HUGE_VAL);
            unchecked.add(label, cell.unchecked ? its_unchecked : HUGE_VAL);
          }
        }
      }
    }
    for (const auto& [name, s] : {std::pair{"checked", &summary}, std::pair{"unchecked", &unchecked}}) {
      if (s->cells == 0) continue;
      const std::string text = fmt::format("{} cells, {} behind, median {:.3g}, worst {:.3g} ({})", s->cells,
                                           s->behind, median(s->ratios), s->worst, s->worst_cell);
      fmt::print("{}: {}\n", name, text);
      cells.note(name, text);
    }
    frame.write(cells, "cells");
    frame.write(table);
  });
}
