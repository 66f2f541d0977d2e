#include "kepler/table.hpp"

#include <cmath>

// What adaptivity gains at each eccentricity: steps of HTVI4 over T = 10, fixed and with the gamma monitor,
// at the same position error (Section 3.3 of the paper says that low eccentricities neither need nor profit
// from it).

namespace {

using namespace experiment;

/// Result of a run and the step at which its position error is `target`, by the order of the method.
struct Matched {
  double h;
  KeplerResult result;
};

Matched at_error(const KeplerRow& row, double eccentricity, double target, double horizon) {
  Matched best{row.h, {}};
  double distance = 1e9;
  // On few steps the end of the last one moves about, and the error with it: the nearest of some tries.
  double h = row.h;
  for (int k = 0; k < 12; ++k) {
    KeplerRow tried = row;
    tried.h = h;
    const KeplerTable table{.eccentricity = eccentricity, .htvi = {tried}, .verlet_h = 1.0, .rounds = 1};
    const KeplerResult result = runs_authors(table, horizon).front().measure();
    const double off = std::abs(std::log(result.global_error / target));
    if (off < distance) distance = off, best = {h, result};
    if (off < 0.02) break;
    h *= std::pow(target / result.global_error, 0.25);
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  double target = 1e-6, horizon = 10.0;
  return run(
      argc, argv, "eccentricity_gain", "Steps of HTVI4 with and without a monitor at each eccentricity",
      [&](CLI::App& app) {
        add_number(app, "--error", target, {.low = 1e-10, .high = 1e-4},
                   "Position error at which the runs are compared");
        add_number(app, "--horizon", horizon, {.low = 1.0, .high = 1e3}, "Physical time T to reach");
      },
      [&](Frame& frame) {
        avi::Table out = frame.table({"eccentricity", "monitor", "h", "steps", "min_step", "max_step",
                                      "energy_error", "global_error"});
        out.note("target", target);
        out.note("horizon", horizon);
        for (int tenths = 0; tenths <= 9; ++tenths) {
          const double e = tenths / 10.0;
          frame.progress("e = " + avi::rounded(e), e);
          if (frame.quick && tenths % 4 != 1) continue;
          for (const KeplerRow& row : {KeplerRow{"none", 0.02 * (1.0 - e) * std::sqrt(1.0 - e), 0.0, 0.0},
                                       KeplerRow{"gamma", 0.03, 0.0, 1e6}}) {
            const auto [h, r] = at_error(row, e, target, horizon);
            out.row(e, row.monitor, h, r.steps, r.min_step, r.max_step, r.energy_error, r.global_error);
          }
        }
        frame.progress("done", 1.0);
        frame.write(out);
      });
}
