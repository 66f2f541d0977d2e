#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

// minimise() on the paper's problem, with the paper's stopping test, beside the methods of Table 6.

namespace optimiser_comparison_test {

double gradients(const std::string& method, double delta) {
  for (const auto& row : data::quick.rows("optimiser_comparison", {{"method", method}}))
    if (std::abs(row.number("delta") / delta - 1.0) < 1e-9)
      return row.text("converged") == "1" ? row.number("gradient_evaluations") : 1e99;
  ADD_FAILURE() << "no row " << method << " " << delta;
  return 0.0;
}

TEST(OptimiserComparison, OursNeedsFewGradientsWithItsDefaults) {
  EXPECT_LE(gradients("minimise_m7", 1e-2), 35);    // measured 30
  EXPECT_LE(gradients("minimise_m7", 1e-10), 75);   // measured 64; 64 to 72 from starts moved by 1e-7
  EXPECT_LE(gradients("minimise_m0", 1e-2), 40);    // measured 31
  EXPECT_LE(gradients("minimise_m0", 1e-10), 120);  // measured 113; 93 to 125
}

TEST(OptimiserComparison, TheMethodsOfTheTableNeedMoreFromTheSecondToleranceOn) {
  // At 1e-2 the trust region takes 31 gradients, one fewer than ours; at 1e-3 47 against 35.
  for (int k = 3; k <= 10; ++k)
    for (const char* method : {"htvi", "nag", "adam", "adagrad", "rmsprop", "trust_region"})
      EXPECT_GT(gradients(method, std::pow(10.0, -k)), 1.2 * gradients("minimise_m7", std::pow(10.0, -k)))
          << method << " " << k;
}

}  // namespace optimiser_comparison_test
