#include "common/methods/search.hpp"
#include "kepler/table.hpp"

#include <cmath>

// The gain from adaptivity at each eccentricity: steps of HTVI4 over T = 10, with fixed steps and with the
// gamma monitor, at the same position error. (Section 3.3 of the paper says that low eccentricities neither
// need adaptivity nor profit from it.)

void experiment::conduct(Frame& frame) {
  constexpr double target = 1e-6;  // position error
  Table& out = frame.table(
      {"eccentricity", "monitor", "h", "steps", "min_step", "max_step", "energy_error", "global_error"});
  out.note("target", target);
  for (int tenths = 0; tenths <= 9; ++tenths) {
    const double e = tenths / 10.0;
    frame.progress("e = " + rounded(e), e);
    if (frame.quick && tenths % 4 != 1) continue;
    for (KeplerRow row : {KeplerRow{"none", 0.02 * (1.0 - e) * std::sqrt(1.0 - e), 0.0, 0.0},
                          KeplerRow{"gamma", 0.03, 0.0, 1e6}}) {
      // With few steps, the end of the last one varies with h, and the error with it; so the nearest of
      // several tries is taken.
      KeplerResult r;
      const auto error = [&](double h) {
        row.h = h;
        r = htvi4_runs("authors", {.eccentricity = e, .htvi = {row}}).front().measure();
        return r.global_error;
      };
      (void)error(matched_step(error, target, row.h, {.order = 4.0, .tries = 12}));
      out.row(e, row.monitor, row.h, r.steps, r.min_step, r.max_step, r.energy_error, r.global_error);
    }
  }
}
