#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

// A hundred periods of the long runs: growth laws.

namespace long_horizon_test {

TEST(LongHorizon, ErrorsGrowAsTheory) {
  for (const auto& row : data::quick.rows("long_horizon_laws")) {
    const std::string& method = row.text("method");
    if (method == "runge_kutta_4") {
      // The control: its energy drifts, so that its phase error grows towards t^2 (measured 1.4 by ten
      // periods).
      EXPECT_GT(row.number("phase"), 1.25);
      EXPECT_GT(row.number("energy"), 0.3);
      continue;
    }
    if (method != "stationary12" && method != "collocation16") {  // whose phase errors are rounding
      EXPECT_NEAR(row.number("phase"), 1.0, 0.05) << method;
    }
    if (method == "stationary4" || method == "stormer_verlet") {
      EXPECT_LT(std::abs(row.number("energy")), 1e-3) << method;
    }
  }
}

TEST(LongHorizon, SymplecticRunsKeepEnergyAndAngularMomentum) {
  // Twice what was measured after 100 periods; rounding is another with and without vector units (stationary
  // 12: from 2e-13 to 9e-13 seen).
  const std::map<std::string, double> energy{{"stationary4", 4.2e-6},
                                             {"stationary12", 2e-12},
                                             {"collocation16", 1.6e-12},
                                             {"stormer_verlet", 7e-3},
                                             {"log_hamiltonian_yoshida4", 5e-13}};
  for (const auto& row : data::quick.rows("long_horizon")) {
    const auto bound = energy.find(row.text("method"));
    if (bound == energy.end()) continue;
    EXPECT_LT(row.number("energy_error"), bound->second) << bound->first;
    // 2.6e-13 was measured for the stationary integrators, which solve an equation a step.
    const bool taylor = bound->first.starts_with("stationary");
    EXPECT_LT(row.number("momentum_error"), taylor ? 5e-13 : 1.5e-13) << bound->first;
  }
}

TEST(LongHorizon, CollocationHasRoundingErrorsOnly) {
  double periods = 0.0;
  for (const auto& row : data::quick.rows("long_horizon", {{"method", "collocation16"}})) {
    periods = row.number("periods");
    // At the apocentre; 7e-15 and 7.2e-11 were measured, 8e-14 where a step ends without its last evaluation.
    EXPECT_LT(std::abs(row.number("energy_now")), 1.4e-14) << periods;
    EXPECT_LT(std::abs(row.number("phase_error")), 1.5e-10) << periods;
  }
  EXPECT_EQ(periods, 10'000.0);
}

TEST(LongHorizon, PhasesEndWhereTheyDid) {
  // Radians, at the end: 100 periods, 10 for the control.
  std::map<std::string, double> phase;
  for (const auto& row : data::quick.rows("long_horizon"))
    phase[row.text("method")] = row.number("phase_error");
  for (const auto& [method, measured] :
       std::map<std::string, double>{{"stationary4", -5.91948e-4},
                                     {"stormer_verlet", -1.0214},
                                     {"log_hamiltonian_yoshida4", -4.1006e-3},
                                     {"runge_kutta_4", 2.3755e-4}})
    EXPECT_NEAR(phase[method] / measured, 1.0, 1e-3) << method;
  EXPECT_LT(std::abs(phase["stationary12"]), 5e-12);  // rounding; seen: from 3e-13 to 2.4e-12
}

}  // namespace long_horizon_test
