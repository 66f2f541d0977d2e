#include "beyond/speed/cost_growth/axes.hpp"
#include "common/frame.hpp"
#include "common/power_law.hpp"
#include "common/timing.hpp"

// Growth of steps and time with eccentricity, horizon, order and dimension: fitted exponents compared with
// the expected ones.

namespace {

using namespace experiment;

/// Times all runs of an axis in turn, writes them to the table, and fits the exponents that are expected.
void report(const Axis& axis, int rounds, Table& runs, Table& fits) {
  std::vector<std::function<void()>> works;
  for (const Measurement& one : axis.runs)
    works.push_back(one.run);
  const auto seconds = interleaved_least_seconds(works, rounds);
  for (std::size_t i = 0; i < axis.runs.size(); ++i) {
    const Measurement& one = axis.runs[i];
    runs.row(axis.name, one.subject, one.value, one.steps, one.energy_error, rounded(seconds[i] / one.units));
  }
  for (const Expected& expected : axis.expected) {
    std::vector<double> value, steps, predicted, time;
    for (std::size_t i = 0; i < axis.runs.size(); ++i)
      if (const Measurement& one = axis.runs[i];
          one.subject == expected.subject && one.value >= expected.from && one.value <= expected.to) {
        value.push_back(one.value);
        steps.push_back(static_cast<double>(one.steps));
        predicted.push_back(expected.steps_at(one.value));
        time.push_back(seconds[i] / one.units);
      }
    const auto of_time = power_law(value, time);
    fits.row(axis.name, expected.subject, of_time.points,
             std::isnan(expected.steps) ? unknown : power_law(value, steps).slope,
             power_law(value, predicted).slope, expected.steps, rounded(of_time.slope, 4));
  }
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& runs = frame.table({"axis", "subject", "value", "steps", "energy_error", "seconds"});
  runs.note("closeness", "1 - e; one Kepler orbit by stationary8 with g = r^(2 gamma), the largest energy "
                         "error |H - H_0| / |H_0| being 1e-6");
  runs.note("periods", "of Kepler's problem at e = 0.9, with one step size for each method");
  runs.note("order", "r; seconds for one Taylor expansion on Kepler's problem");
  runs.note(
      "dimension",
      "n, chain of masses; seconds for one value of H, one automatic gradient, one sweep of collocation of "
      "order 16 (with an automatic gradient unless named), each at the eight stages of a step together");
  Table& fits = frame.table("fit", {"axis", "subject", "points", "steps_exponent", "steps_predicted",
                                    "steps_limit", "seconds_exponent"});
  fits.note("points", "closeness from where rounding is far below 1e-6; all horizons; r from 4; all n");
  fits.note("steps_predicted", "power law through the predicted steps at the values fitted");
  fits.note("steps_limit", "power of the value as it goes to its limit");
  frame.progress("eccentricity", 0.0);
  report(along_eccentricity(frame.quick), frame.quick ? 1 : 3, runs, fits);
  frame.progress("horizon", 0.4);
  report(along_horizon(frame.quick), frame.quick ? 1 : 3, runs, fits);
  frame.progress("order", 0.6);
  report(along_order(), frame.quick ? 1 : 9, runs, fits);
  frame.progress("dimension", 0.8);
  report(along_dimension(frame.quick), 15, runs, fits);
}
