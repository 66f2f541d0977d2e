#include "avi/avi.hpp"
#include "common/methods/printed_htvi.hpp"

#include <gtest/gtest.h>

// Every type and Taylor order up to 7 is symplectic to round-off, on three problems; the Taylor method
// inside, without the symplectic correction, is not.

using avi::Generating, avi::State;

namespace symplecticity_grid_test {

const avi::Quadrature rule = avi::lobatto(4);

/// The Taylor method of order r alone: the control that must fail.
template <class Problem>
struct Taylor {
  avi::TaylorExpansion<Problem, avi::dynamic, experiment::Printed> expansion;
  avi::StepReport step(State<Problem::dimension>& z, double h) {
    const auto d = expansion.expand(z.q, z.p, h);
    for (int i = 0; i < Problem::dimension; ++i) {
      z.q[i] += d.q[static_cast<std::size_t>(i)].value();
      z.p[i] += d.p[static_cast<std::size_t>(i)].value();
    }
    return {};
  }
};

template <class Problem>
void expect_symplectic(const Problem& problem, const State<Problem::dimension>& z, double h) {
  for (int r = 0; r <= 7; ++r) {
    const auto right = avi::htvi_of_order<Generating::type2>(r, problem, rule);
    const auto left = avi::htvi_of_order<Generating::type3>(r, problem, rule);
    // The differences that measure it are good to 1e-13 to 1e-12.
    EXPECT_LT(avi::symplecticity_defect(right, z, h), 1e-11) << "Type II, r = " << r;
    EXPECT_LT(avi::symplecticity_defect(left, z, h), 1e-11) << "Type III, r = " << r;
  }
  for (int r : {1, 2, 3}) {
    const Taylor<Problem> taylor{{problem, r}};
    const double coarse = avi::symplecticity_defect(taylor, z, h),
                 fine = avi::symplecticity_defect(taylor, z, 0.5 * h);
    EXPECT_GT(coarse, 1e-8) << r;
    EXPECT_GT(coarse / fine, 1.8) << "a defect that does not grow with h is round-off; r = " << r;
  }
}

TEST(Symplecticity, OfEveryTypeAndOrderOnThePendulum) {
  const State<1> z{.q = {1.2}, .p = {0.7}};
  expect_symplectic(avi::poincare<1>(avi::Pendulum{}, z), z, 0.4);
}
TEST(Symplecticity, OfEveryTypeAndOrderOnHenonHeiles) {
  const State<2> z{.q = {0.1, -0.3}, .p = {0.4, 0.2}};
  expect_symplectic(avi::poincare<2>(avi::HenonHeiles{}, z), z, 0.4);
}
TEST(Symplecticity, OfEveryTypeAndOrderOnKeplerWithMonitor) {
  const State<2> z = avi::Kepler::exact(0.6, 0.9);
  expect_symplectic(avi::poincare<2>(avi::Kepler{}, z, avi::bounded(avi::NormSquared{}, 0.01, 8.0)), z, 0.1);
}

}  // namespace symplecticity_grid_test
