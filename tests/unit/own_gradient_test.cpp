#include "avi/collocation/collocation.hpp"
#include "avi/solve.hpp"
#include "avi/transform/poincare.hpp"

#include "refusal.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace own_gradient_test {

/// A spring whose gradient is that of one of another strength: which of them is followed can be seen.
struct Spring {
  double strength = 4.0;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0];
  }
  template <class Q, class P>
  auto d_dq(const Q& q, const P&) const {
    Q slope = q;
    slope[0] = strength * q[0];
    return slope;
  }
  template <class Q, class P>
  auto d_dp(const Q&, const P& p) const {
    return p;
  }
};

const avi::State<1> start = systems::at(1.0, 0.0);

TEST(OwnGradient, IsFollowed) {
  const auto orbit = avi::solve(Spring{}, start, 3.0, 1e-10, {.monitor = "fixed", .h = 0.05});
  EXPECT_NEAR(orbit.state.q[0], std::cos(6.0), 1e-10);
  const auto delivered =
      avi::solve(Spring{}, start, std::vector<double>{1.0, 3.0}, 1e-10, {.monitor = "fixed", .h = 0.05});
  EXPECT_NEAR(delivered.states[0].q[0], std::cos(2.0), 1e-10);
  EXPECT_EQ(delivered.state, orbit.state);
}

TEST(OwnGradient, OfHItselfGivesTheSameOrbit) {
  const auto supplied = avi::solve(Spring{1.0}, start, 50.0, 1e-11),
             found = avi::solve(systems::spring, start, 50.0, 1e-11);
  EXPECT_EQ(supplied.run.steps, found.run.steps);
  EXPECT_NEAR(supplied.state.q[0], found.state.q[0], 1e-13);
}

TEST(OwnGradient, ThatIsNotThatOfHIsNotCalledRounding) {
  for (const double strength : {1.001, 4.0}) {
    const auto orbit = avi::solve(Spring{strength}, start, 50.0, 1e-8);
    EXPECT_FALSE(orbit.kept()) << orbit.report();
    EXPECT_GT(orbit.energy_error, 1e-4);
    EXPECT_LT(orbit.energy_rounding, 1e-14);
    EXPECT_NE(orbit.note.find("is not its own"), std::string::npos) << orbit.report();
  }
}

// By as little as H might round in another formula.
TEST(OwnGradient, ThatIsNearlyThatOfHIsNotCalledRounding) {
  for (const auto& [more, tolerance] :
       {std::pair{1e-8, 1e-12}, std::pair{1e-9, 1e-12}, std::pair{1e-9, 1e-11}}) {
    const auto orbit = avi::solve(Spring{1.0 + more}, start, 50.0, tolerance);
    EXPECT_FALSE(orbit.kept()) << orbit.report();
  }
}

/// With the checks of Eigen on, a list that is filled when something is thrown ends the program.
struct Thrower : Spring {
  template <class Q, class P>
  auto d_dp(const Q&, const P& p) const {
    if (p.size() > 0) throw std::domain_error("no slope");
    return p;
  }
};

TEST(OwnGradient, MayThrow) {
  const avi::State<avi::dynamic> z{.q = {1.0}, .p = {0.0}};
  EXPECT_THROW((void)avi::solve(Thrower{}, z, 3.0, 1e-8), std::domain_error);
  EXPECT_THROW((void)avi::collocation(avi::poincare(Thrower{}, z), 8), std::domain_error);
}

/// Its slopes by q are of another number than its positions.
struct Misfit {
  Eigen::Index size;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return 0.5 * p.squaredNorm() + 0.5 * q.squaredNorm();
  }
  template <class Q, class P>
  auto d_dq(const Q& q, const P&) const {
    avi::Vector<typename Q::Scalar, avi::dynamic> slopes(size);
    for (Eigen::Index i = 0; i < size; ++i)
      slopes[i] = q[0];
    return slopes;
  }
  template <class Q, class P>
  auto d_dp(const Q&, const P& p) const {
    return p;
  }
};

TEST(OwnGradient, HasAsManyEntriesAsThereAreDegreesOfFreedom) {
  const avi::State<avi::dynamic> z{.q = {1.0, 2.0, 3.0}, .p = {0.0, 0.0, 0.0}};
  const avi::State<3> same{.q = z.q, .p = z.p};
  for (const Eigen::Index size : {2, 4}) {
    const Misfit misfit{size};
    const std::string sentence =
        "Number of entries of d_dq is " + std::to_string(size) + "; it must be that of q and of p, 3.";
    EXPECT_EQ(refusal([&] { (void)avi::solve(misfit, z, 1.0, 1e-8); }), sentence);
    EXPECT_EQ(refusal([&] { (void)avi::solve(misfit, same, 1.0, 1e-8); }), sentence);
    EXPECT_EQ(refusal([&] { (void)avi::poincare(misfit, z); }), sentence);
    EXPECT_EQ(refusal([&] { (void)avi::poincare(misfit, same); }), sentence);
  }
}

}  // namespace own_gradient_test
