#include "bregman/printed/cloning_printed.hpp"
#include "common/problems/correlated_quartic.hpp"

#include <gtest/gtest.h>

#include <cmath>

// The last equation of phase-space cloning is printed as r~' = +grad_q~ H_2. Both copies start at one point
// and, if each solves the same equations, stay together but for the error of the splitting, O(h^2).

namespace cloning_sign_test {

/// Root mean square of the entries of q~ - q after `steps` steps of size h.
double distance_of_copies(double sign, double h, long steps) {
  const experiment::CorrelatedQuartic f(3, 0.9);
  // Near the minimum, where every step tried resolves the motion.
  avi::ExtendedPoint z{.q = Eigen::Vector3d(1.3, 0.8, 1.5), .t = 1.0, .r = avi::VectorX::Ones(f.size())},
      clone = z;
  const auto stages = experiment::merged_stages(experiment::CloneComposition::strang);
  for (long k = 0; k < steps; ++k)
    experiment::cloning_printed_step(avi::BregmanFamily::adaptive(4.0, 1.0), f, h, stages, z, clone, sign);
  return std::sqrt((clone.q - z.q).squaredNorm() / f.size());
}

TEST(CloningSign, CopiesStayTogetherForTheMeantSignOnly) {
  for (const double sign : {1.0, -1.0}) {
    double before = 0.0;
    for (const long steps : {10, 20, 40, 80}) {
      const double distance = distance_of_copies(sign, 0.05 / static_cast<double>(steps), steps);
      if (before > 0.0) {
        EXPECT_NEAR(std::log2(before / distance), sign < 0.0 ? 2.0 : 0.0, 0.05) << steps;
      }
      before = distance;
    }
  }
}

}  // namespace cloning_sign_test
