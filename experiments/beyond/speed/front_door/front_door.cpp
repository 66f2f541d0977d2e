#include "beyond/speed/front_door/race.hpp"
#include "beyond/speed/work_precision/peers/peers.hpp"
#include "common/frame.hpp"

#include <fmt/format.h>

#include <cmath>

// avi::solve() as a user calls it, compared with the integrators of other libraries: the time of the whole
// call for the same position error at the end.

void experiment::conduct(Frame& frame) {
  using namespace experiment::front_door;
  const Budget fine{
      .longest_run = 0.5, .least_block = 1e-3, .rounds = 7, .ratio = std::sqrt(0.1), .refined = 4};
  const Budget budget = frame.longer ? fine : Budget{};
  const double longest = frame.longer ? 1000.0 : frame.quick ? 10.0 : 100.0;
  Table& table = frame.table({"scene", "kind", "held_out", "horizon", "method", "setting", "error", "seconds",
                              "steps", "evaluations"});
  Table& cells = frame.table("cells", {"scene", "kind", "held_out", "horizon", "target", "ours", "best_peer",
                                       "best_peer_name", "ratio", "ours_evaluations", "peer_evaluations",
                                       "ours_setting", "peer_setting"});
  table.note("peers", work_precision::peers_present());
  cells.note("peers", work_precision::peers_present());
  double done = 0.0;
  for (const auto all = scenes(); const Scene& scene : all) {
    frame.progress(scene.name, done++, all.size());
    if (scene.held_out && frame.quick) continue;
    for (const double horizon : scene.horizons) {
      if (horizon > longest) continue;
      const double span = horizon * scene.unit;
      const Contest contest = scene.make(span);
      if (contest.reference_error > 1e-12)
        cells.note(fmt::format("reference error of {} {:g}", scene.name, horizon),
                   rounded(contest.reference_error, 2));
      const Outcome outcome = Race(contest, budget).result();
      for (const Point& p : outcome.points)
        table.row(scene.name, scene.kind, scene.held_out, horizon, contest.families[p.family].method,
                  rounded(p.setting, 4), rounded(p.error, 4), rounded(p.seconds, 4), p.steps, p.evaluations);
      for (const auto& [target, ours, peer] : outcome.cells) {
        if (!ours && !peer) continue;
        const auto of = [](const std::optional<Point>& p, auto Point::*number) {
          return p ? static_cast<double>((*p).*number) : unknown;
        };
        cells.row(scene.name, scene.kind, scene.held_out, horizon, target,
                  rounded(of(ours, &Point::seconds), 4), rounded(of(peer, &Point::seconds), 4),
                  peer ? contest.families[peer->family].method : "none",
                  rounded(of(ours, &Point::seconds) / of(peer, &Point::seconds), 4),
                  of(ours, &Point::evaluations), of(peer, &Point::evaluations),
                  rounded(of(ours, &Point::setting), 4), rounded(of(peer, &Point::setting), 4));
      }
    }
  }
}
