#include "avi/core/dot.hpp"
#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/euler_b.hpp"
#include "common/table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

// Every entry point refuses the arguments of the experiment bad_input in one sentence with the value and the
// range; what is found out during a run only ends it with a name.

namespace bad_input_test {

using namespace avi;
using experiment::Table;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(BadInput, IsRefusedInOneSentence) {
  const Table table = Table::read(AVI_CHECK_DIR "/quick/bad_input.tsv");
  // What no argument shows ends the run, with a name.
  const std::set<std::string> found_on_the_way{"q at the start", "p at the start", "g", "g on the way"};
  std::map<std::string, int> tried;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string &sentence = table.text(i, "sentence"), &value = table.text(i, "value");
    const std::string where = table.text(i, "part") + ", " + table.text(i, "argument") + " = " + value;
    ++tried[table.text(i, "part")];
    EXPECT_TRUE(sentence.ends_with(".")) << where << ": " << sentence;
    if (found_on_the_way.contains(table.text(i, "argument"))) {
      const std::string& ending = table.text(i, "ending");
      EXPECT_TRUE(ending == "non_finite" || ending == "bad_monitor" || ending == "not_converged")
          << where << ": " << ending;
      EXPECT_NE(sentence.find(ending), std::string::npos) << where << ": " << sentence;
      continue;
    }
    EXPECT_EQ(table.text(i, "ending"), "refused") << where;
    EXPECT_NE(sentence.find(" is " + value + "; it must be "), std::string::npos)
        << where << ": " << sentence;
  }
  EXPECT_EQ(tried.size(), 8u);
  EXPECT_GE(table.rows.size(), 256u);
}

/// Backwards is refused only where the end lies ahead.
TEST(BadInput, ANegativeStepIsGood) {
  auto method = stormer_verlet<2>([](const auto& q) { return Kepler::potential_gradient(q); });
  auto z = Kepler::pericentre(0.5);
  EXPECT_EQ(integrate(method, z, -0.1, {.steps = 10}).steps, 10);
  EXPECT_EQ(integrate(method, z, -0.1, {.time = -1.95}).steps, 10);
}

TEST(BadInput, AStepTooSmallForTheClockEndsTheRun) {
  auto method = stormer_verlet<2>([](const auto& q) { return Kepler::potential_gradient(q); });
  const auto run = [&](double t, double h) {
    auto z = Kepler::pericentre(0.5);
    z.t = t;
    const avi::Run end = integrate(method, z, h, {.time = 2.0, .steps = 3 << 20});
    EXPECT_TRUE(z.finite());
    return std::pair(end.outcome, end.steps);
  };
  // A step below the rounding of t; and one that is above it at first, at t = 0, but would never arrive.
  EXPECT_EQ(run(1.0, 1e-20), std::pair(Outcome::stalled, 1L << 20));
  EXPECT_EQ(run(0.0, 1e-300), std::pair(Outcome::stalled, 1L << 20));
  EXPECT_EQ(run(0.0, 1.5e-16), std::pair(Outcome::stalled, 1L << 20));
  // 2e15 steps: nobody will wait for them, but they are that many.
  EXPECT_EQ(run(0.0, 1e-15), std::pair(Outcome::step_limit, 3L << 20));
}

TEST(BadInput, MonitorsThatAreNotPositive) {
  const auto start = Kepler::pericentre(0.5);
  for (double g : {0.0, -1.0, nan}) {
    auto method = euler_b<2>(Kepler{}, start, [g](const auto& q) { return g * (q[0] * q[0] + 1.0); });
    auto z = start;
    const avi::Run run = integrate(method, z, 0.01, {.steps = 10});
    EXPECT_EQ(run.outcome, Outcome::bad_monitor) << g;
    EXPECT_EQ(z.q, start.q);
  }
}

/// Not a number anywhere is not a number at the end, never a small defect.
TEST(BadInput, DiagnosticsOfWhatIsNotANumber) {
  const auto broken = [](const VectorX& z) { return VectorX(VectorX::Constant(z.size(), nan)); };
  EXPECT_TRUE(std::isnan(symplecticity_defect(broken, VectorX(VectorX::Ones(2)))));
  EXPECT_TRUE(std::isnan(fit_order(std::vector{1.0, 2.0, 3.0}, std::vector{nan, nan, nan}).order));
}

}  // namespace bad_input_test
