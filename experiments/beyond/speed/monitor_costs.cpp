#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "common/methods/printed_htvi.hpp"
#include "common/methods/search.hpp"
#include "common/timing.hpp"
#include "kepler/table.hpp"

#include <cmath>

// The cost of each monitor for Kepler's problem at the same energy error: steps per orbit, and time per step,
// of HTVI4. The fictive step is adjusted until the largest energy error over three orbits has the desired
// value.

namespace {

using namespace experiment;
using avi::Kepler;

constexpr double orbits = 3.0;
constexpr avi::Until until{.time = 2.0 * M_PI * orbits, .steps = 3'000'000};

/// HTVI4 with this monitor.
Method2 runner_with(const auto& monitor) {
  return Method2(Kepler{}, [=](const State2& start) {
    return avi::type2<3, Authors>(avi::poincare<2>(Kepler{}, start, monitor), avi::simpson());
  });
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& out = frame.table({"eccentricity", "monitor", "target", "h", "energy_error", "position_error",
                            "steps_per_orbit", "evaluations_per_step", "longest_over_shortest", "seconds"});
  out.note("method", "HTVI4 as the authors ran it, Type II, r = 3, Simpson's rule");
  out.note("seconds", "per orbit, the least of several rounds, in each of which every monitor runs once");
  const auto eccentricities = frame.quick ? std::vector{0.9} : std::vector{0.9, 0.99};
  const auto targets = frame.quick ? std::vector{1e-5} : std::vector{1e-5, 1e-7};
  double done = 0.0;
  for (double e : eccentricities)
    for (double target : targets) {
      struct Cost {
        std::string name;
        double h;
        KeplerResult result;
        avi::AnyMethod<2> method;
      };
      std::vector<Cost> costs;
      const auto row = [&](const char* name, const auto& monitor, double first) {
        frame.progress(name, done);
        const KeplerRow start{name, first, unknown, unknown};
        KeplerRun run{{"htvi4", "authors", 3, "simpson"}, start, runner_with(monitor), e, until};
        KeplerResult r;
        const auto error = [&](double tried) {
          run.row.h = tried;
          r = run.measure();
          return r.energy_error;
        };
        // From a step that is far too long.
        const double h = matched_step(error, target, first, {.order = 4.0, .tries = 70, .too_coarse = 100.0});
        if (h != run.row.h) (void)error(h);
        costs.push_back({name, h, r, run.runner.make(Kepler::pericentre(e))});
        done += 1.0 / (8 * eccentricities.size() * targets.size());
      };
      const Kepler kepler;
      row("none", avi::Unit{}, 0.01);
      row("gamma", avi::NormSquared{}, 0.5);
      row("gamma_half", avi::Gamma{0.5}, 0.1);
      row("gamma_three_quarters", avi::Gamma{0.75}, 0.5);
      row("arclength", avi::Arclength<Kepler>{kepler, -0.5}, 0.5);
      row("energy", avi::bounded(avi::Energy<Kepler>{kepler, 0.5}, 1e-4, 2.0), 0.5);
      row("truncation_root", avi::Truncation<Kepler, 4>{kepler, 0.5, 1.0}, 0.5);
      row("inverse_lagrangian", avi::bounded(avi::Energy<Kepler>{kepler, 0.0}, 1e-3, 3.0), 0.5);
      std::vector<std::function<void()>> works;
      for (Cost& each : costs)
        works.emplace_back([&each, e] {
          State2 z = Kepler::pericentre(e);
          (void)avi::integrate(each.method, z, each.h, {.steps = each.result.steps});
        });
      const auto least = interleaved_least_seconds(works, frame.quick ? 1 : 10);
      for (std::size_t i = 0; i < costs.size(); ++i) {
        const auto& [name, h, r, method] = costs[i];
        const double n = static_cast<double>(r.steps);
        out.row(e, name, target, h, r.energy_error, r.global_error, n / orbits,
                static_cast<double>(r.evaluations) / n, r.max_step / r.min_step, rounded(least[i] / orbits));
      }
    }
}
