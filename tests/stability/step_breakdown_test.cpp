// quick: step_breakdown
#include "avi/io/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

// Every integrator breaks where linear theory says or before, and says how.

namespace {

class StepBreakdown : public testing::Test {
 protected:
  const avi::Table table = avi::Table::read(AVI_CHECK_DIR "/quick/step_breakdown.tsv");

  [[nodiscard]] std::size_t row(const std::string& problem, const std::string& method,
                                const std::string& monitor = "none") const {
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (table.text(i, "problem") == problem && table.text(i, "method") == method &&
          table.text(i, "monitor") == monitor)
        return i;
    throw std::runtime_error("no row " + problem + " " + method);
  }
};

TEST_F(StepBreakdown, LinearTheoryIsMetOnTheOscillator) {
  // Stormer-Verlet: 2; the classical Runge-Kutta method: sqrt(8); the triple jump: 1.573 (Yoshida 1990).
  EXPECT_NEAR(table.number(row("oscillator", "stormer_verlet"), "h_linear"), 2.0, 1e-3);
  EXPECT_NEAR(table.number(row("oscillator", "runge_kutta_4"), "h_linear"), std::sqrt(8.0), 1e-3);
  EXPECT_NEAR(table.number(row("oscillator", "yoshida4"), "h_linear"), 1.573, 1e-3);
  for (const char* method : {"stormer_verlet", "yoshida4", "runge_kutta_4"})
    EXPECT_NEAR(table.number(row("oscillator", method), "h") /
                    table.number(row("oscillator", method), "h_linear"),
                1.0, 0.01)
        << method;
}

TEST_F(StepBreakdown, OneNotchBeyondEveryRunEndsWithItsReason) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string where =
        table.text(i, "problem") + " " + table.text(i, "method") + " " + table.text(i, "monitor");
    const std::string& beyond = table.text(i, "beyond");
    if (table.text(i, "method") == "log_hamiltonian") {
      EXPECT_EQ(beyond, "none") << "its leapfrog stays on the ellipse whatever the step";
      continue;
    }
    EXPECT_TRUE(beyond == "energy" || beyond == "not_converged" || beyond == "non_finite" ||
                beyond == "bad_monitor" || beyond == "diverged")
        << where << " " << beyond;
    EXPECT_LT(table.number(i, "h_beyond"), 1.003 * table.number(i, "h")) << where;
    EXPECT_LT(table.number(i, "time_reached"), 310.0) << where;
  }
}

TEST_F(StepBreakdown, AMonitorWidensTheRangeOfSteps) {
  // At e = 0.9 in units of the pericentre's time; measured 0.26 to 0.29 against 0.12 and 0.29 for HTVI2
  // and 4.
  for (const char* method : {"htvi2", "htvi4"})
    EXPECT_GT(table.number(row("kepler", method, "r^1.5"), "h"), 0.5 * 0.24) << method;
}

}  // namespace
