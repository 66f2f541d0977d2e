#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

// Every integrator breaks and says how: on the oscillator where linear theory says, unless further windows of
// stability follow the first limit, and before it on nonlinear problems.

namespace step_breakdown_test {

scorecard::Row row(const std::string& problem, const std::string& method,
                   const std::string& monitor = "none") {
  return scorecard::find(data::quick("step_breakdown"),
                         {{"problem", problem}, {"method", method}, {"monitor", monitor}});
}

TEST(StepBreakdown, LinearTheoryIsMetOnTheOscillator) {
  // Stormer-Verlet: 2; the classical Runge-Kutta method: sqrt(8); the triple jump: 1.573 (Yoshida 1990);
  // stationary 4 has to break where the eigenvalues of its step say, wherever that is.
  EXPECT_NEAR(row("oscillator", "stormer_verlet").number("h_linear"), 2.0, 1e-3);
  EXPECT_NEAR(row("oscillator", "runge_kutta_4").number("h_linear"), std::sqrt(8.0), 1e-3);
  EXPECT_NEAR(row("oscillator", "yoshida4").number("h_linear"), 1.573, 1e-3);
  for (const char* method : {"stormer_verlet", "yoshida4", "runge_kutta_4", "stationary4"})
    EXPECT_NEAR(row("oscillator", method).number("h") / row("oscillator", method).number("h_linear"), 1.0,
                0.01)
        << method;
}

TEST(StepBreakdown, CollocationIsStableAtEveryStep) {
  // Where sweeps do not contract, from 3.03 and 9.4 on, Newton's method solves the oscillator, up to the
  // largest step that is tried. Measured: Henon-Heiles 4.7, Kepler 1.9.
  for (const std::string method : {"collocation4", "collocation16"}) {
    const auto its = row("oscillator", method);
    EXPECT_EQ(its.text("linear_reason"), "none") << method;
    EXPECT_EQ(its.number("h"), 16.0) << method;
    EXPECT_EQ(its.text("beyond"), "none") << method;
    EXPECT_LT(its.number("energy_error"), 1e-9) << method;
  }
  EXPECT_GT(row("henon_heiles", "collocation16").number("h"), 4.0);
  EXPECT_GT(row("kepler", "collocation16", "r^1.5").number("h"), 1.6);
}

TEST(StepBreakdown, LargestStepsAreThoseMeasured) {
  struct Limit {
    const char *problem, *method, *monitor;
    double h;
  };
  // The start that breaks first may change with the last bit: three in a hundred.
  for (const auto& [problem, method, monitor, h] : {Limit{"henon_heiles", "stormer_verlet", "none", 0.649},
                                                    {"henon_heiles", "yoshida4", "none", 0.754},
                                                    {"henon_heiles", "kahan_li8", "none", 2.53},
                                                    {"henon_heiles", "runge_kutta_4", "none", 0.402},
                                                    {"henon_heiles", "stationary4", "none", 0.9371},
                                                    {"henon_heiles", "stationary8", "none", 0.8769},
                                                    {"kepler", "stormer_verlet", "none", 0.01627},
                                                    {"kepler", "yoshida4", "none", 0.02249},
                                                    {"kepler", "kahan_li8", "none", 0.05136},
                                                    {"kepler", "runge_kutta_4", "none", 0.0089},
                                                    {"kepler", "stationary4", "none", 0.01464},
                                                    {"kepler", "stationary8", "none", 0.01739},
                                                    {"kepler", "adaptive_verlet", "r^1.5", 0.1108},
                                                    {"kepler", "hairer_soderlind", "r^1.5", 0.1332},
                                                    {"kepler", "stationary4", "r^1.5", 0.4076},
                                                    {"kepler", "stationary8", "r^1.5", 0.5978}})
    EXPECT_NEAR(row(problem, method, monitor).number("h") / h, 1.0, 0.03) << problem << ' ' << method;
}

TEST(StepBreakdown, OneNotchBeyondEveryRunEndsWithItsReason) {
  for (const auto& its : data::quick.rows("step_breakdown")) {
    const std::string where = its.text("problem") + " " + its.text("method") + " " + its.text("monitor");
    const std::string& beyond = its.text("beyond");
    if (its.text("method") == "log_hamiltonian") {
      EXPECT_EQ(beyond, "none") << "its leapfrog stays on the ellipse whatever the step";
      continue;
    }
    if (its.text("linear_reason") == "none" && its.text("problem") == "oscillator") continue;
    EXPECT_TRUE(beyond == "energy" || beyond == "not_converged" || beyond == "non_finite" ||
                beyond == "bad_monitor" || beyond == "diverged")
        << where << " " << beyond;
    EXPECT_LT(its.number("h_beyond"), 1.003 * its.number("h")) << where;
    EXPECT_LT(its.number("time_reached"), 310.0) << where;
  }
}

}  // namespace step_breakdown_test
