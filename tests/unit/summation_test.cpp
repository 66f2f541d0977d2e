#include "avi/core/summation.hpp"

#include "avi/avi.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <limits>

using avi::State;

namespace summation_test {

TEST(Summation, KeepsWhatRoundingCutsOff) {
  double kept = 1.0, low = 0.0, plain = 1.0, unused = 0.0;
  for (int i = 0; i < 1000; ++i) {
    avi::add<avi::Summation::compensated>(kept, low, 1e-17);
    avi::add<avi::Summation::plain>(plain, unused, 1e-17);
  }
  EXPECT_NEAR(kept - 1.0 + low, 1e-14, 1e-18);
  EXPECT_EQ(kept, 1.0 + 45.0 * std::numeric_limits<double>::epsilon()) << "1e-14 is 45.04 ulp";
  EXPECT_EQ(plain, 1.0);
  EXPECT_EQ(unused, 0.0);
}

TEST(Summation, OfAClockBeginsAnewWhereItIsSet) {
  avi::ClockSum sum;
  double t = 1.0;
  sum.add(t, 1e-16);
  EXPECT_EQ(t, 1.0);
  sum.add(t, 1e-16);
  EXPECT_EQ(t, 1.0 + std::numeric_limits<double>::epsilon()) << "2e-16 is 0.9 ulp";
  t = 1.0;
  sum.add(t, 1e-16);
  t = 2.0;
  sum.add(t, 1.9e-16);
  EXPECT_EQ(t, 2.0) << "nothing is left of what was added to 1";
}

struct Spring {
  static constexpr int dimension = 1;
  using Vec = avi::Vector<double, 1>;
  static Vec potential_gradient(const Vec& q) { return q; }
};

TEST(Summation, OfTheClockOfEveryMethod) {
  const State<1> start = systems::at(1.0, 0.0);
  const auto check = [&](const char* name, auto method) {
    State<1> z = start;
    ASSERT_TRUE(avi::integrate(method, z, 0.1, {.steps = 100000}).ok());
    EXPECT_NEAR(z.t, 1e4, 2e-12) << name << " is off by more than an ulp";
    z.t = 0.0;
    ASSERT_TRUE(method.step(z, 0.1).ok());
    EXPECT_EQ(z.t, 0.1) << name;
  };
  check("splitting", avi::splitting(avi::Separable<Spring>(), avi::compositions::kahan_li6));
  check("compensated splitting",
        avi::splitting<avi::Summation::compensated>(avi::Separable<Spring>(), avi::compositions::kahan_li6));
  check("stormer_verlet", avi::stormer_verlet<1>(&Spring::potential_gradient));
  check("htvi", avi::htvi<4>(avi::poincare(systems::spring, start)));
  check("collocation", avi::collocation(avi::poincare(systems::spring, start), 4));
}

}  // namespace summation_test
