#include "avi/avi.hpp"
#include "bregman/printed/cloning_printed.hpp"
#include "bregman/printed/extended_splitting.hpp"
#include "bregman/printed/htvi_printed.hpp"
#include "common/methods/printed_htvi.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/rules/bregman_cloning.hpp"

#include <gtest/gtest.h>

// Two ways to the same iterates, written from different formulas, must agree to round-off.

using avi::BregmanFamily, avi::ExtendedPoint, avi::VectorX, experiment::CorrelatedQuartic;

namespace bregman_equivalence_test {

const BregmanFamily families[] = {BregmanFamily::direct(4.0), BregmanFamily::direct(2.5, 0.3),
                                  BregmanFamily::adaptive(4.0, 1.0), BregmanFamily::adaptive(10.0, 0.5)};

/// Step that keeps the first steps from the paper's start well below the limit of stability.
double step(const BregmanFamily& family) { return 2e-3 / family.order(); }

/// Largest distance between the iterates of a method and of extended steps, relative to |x|.
double largest_distance(const auto& method, const auto& extended_step, const BregmanFamily& family, double h,
                        long steps) {
  const CorrelatedQuartic f;
  ExtendedPoint z = avi::bregman_start(family, f, f.start());
  double worst = 0.0;
  avi::run_updates(f, method, f.start(), {.delta = 0.0, .iterations = steps},
                   [&](const avi::Iterate& at, long k, long) {
                     if (k > 0) extended_step(family, f, h, z);
                     worst = std::max(worst, (at.x - z.q).norm() / at.x.norm());
                   });
  return worst;
}

TEST(Htvi, MomentumFormIsThePrintedForm) {
  for (const auto& family : families) {
    const double h = step(family);
    const auto printed = [](auto&&... arguments) { experiment::htvi_printed_step(arguments...); };
    // Rounding differs in the last bit, and the dynamics amplifies it.
    EXPECT_LT(largest_distance(avi::BregmanHtvi{.family = family, .h = h}, printed, family, h, 10), 5e-14);
    EXPECT_LT(largest_distance(avi::BregmanHtvi{.family = family, .h = h}, printed, family, h, 1000), 1e-11);
    // The control: another weight C is seen at once.
    auto other = family;
    other.C *= 1.001;
    EXPECT_GT(largest_distance(avi::BregmanHtvi{.family = other, .h = h}, printed, family, h, 1000), 1e-7);
  }
}

TEST(HeavyBall, HasTheIteratesOfTheMomentumForm) {
  const CorrelatedQuartic f;
  const avi::Stopping stopping{.delta = 0.0, .iterations = 1000};
  for (const auto& family : families)
    for (const auto clock : {avi::Clock::euler, avi::Clock::exact}) {
      const double h = step(family);
      const avi::BregmanStart from{.t = 1.3, .momentum = 0.7};
      const auto ball =
          avi::run_updates(f, avi::BregmanHeavyBall{.family = family, .h = h, .from = from, .clock = clock},
                           f.start(), stopping);
      const auto momentum = avi::run_updates(
          f, avi::BregmanHtvi{.family = family, .h = h, .from = from, .clock = clock}, f.start(), stopping);
      EXPECT_LT((ball.last.x - momentum.last.x).norm() / momentum.last.x.norm(), 4.5e-10)
          << "measured 2.3e-10: the dynamics amplifies rounding";
      EXPECT_GT((momentum.last.x - f.start()).norm(), 1.0) << "it has moved";
    }
}

TEST(Splitting, ThreeFlowsAndPrintedUpdateShareTheirIterates) {
  for (const auto& family : families) {
    const double h = step(family);
    const avi::BregmanSplitting method{.family = family, .h = h};
    const auto printed = [](auto&&... arguments) { experiment::splitting_printed_step(arguments...); };
    const auto flows = [](auto&&... arguments) { experiment::three_flow_step(arguments...); };
    EXPECT_LT(largest_distance(method, printed, family, h, 500), 1e-13);
    EXPECT_LT(largest_distance(method, flows, family, h, 500), 1e-13);
  }
}

TEST(Cloning, TheCopyThatIsReadNeverSeesTheOther) {
  const CorrelatedQuartic f;
  using experiment::CloneComposition;
  const long gradients[] = {3, 7, 19}, useful[] = {1, 3, 9};
  for (const auto& family : families)
    for (const auto composition :
         {CloneComposition::strang, CloneComposition::yoshida4, CloneComposition::yoshida6}) {
      const avi::Stopping stopping{.delta = 0.0, .iterations = 50};
      const double h = 0.3 * step(family);
      const auto decoupled = avi::run_updates(
          f, experiment::BregmanCloning{.family = family, .h = h, .composition = composition}, f.start(),
          stopping);
      for (double sign : {-1.0, 1.0}) {
        ExtendedPoint z = avi::bregman_start(family, f, f.start()), clone = z;
        long calls = 0;
        const auto counted = [&](const VectorX& x, VectorX& g) { return ++calls, f(x, g); };
        for (int k = 0; k < 50; ++k)
          experiment::cloning_printed_step(family, counted, h, experiment::merged_stages(composition), z,
                                           clone, sign);
        EXPECT_EQ(z.q, decoupled.last.x) << experiment::clone_name(composition);
        const auto which = static_cast<std::size_t>(composition);
        EXPECT_EQ(calls, 50 * gradients[which]);
        // One more an iteration is the stopping test's; one at the start.
        EXPECT_EQ(decoupled.gradient_evaluations, 1 + 50 * (useful[which] + 1));
      }
    }
}

/// The extended Hamiltonian as a user of the generic machinery would write it: q = (x, t), p = (r, r^t).
template <int d>
struct Extended {
  BregmanFamily family;

  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using S = typename Q::Scalar;
    const S t = q[d];
    S form(0.0), square(0.0);
    for (int i = 0; i < d; ++i) {
      square += p[i] * p[i];
      for (int j = 0; j < d; ++j)
        form += std::pow(0.9, std::abs(i - j)) * ((q[i] - 1.0) * (q[j] - 1.0));
    }
    const double s = family.s(), P0 = family.order();
    return (0.5 * P0) * (avi::power(t, -family.p - s) * square) +
           (family.C * P0) * (avi::power(t, 2.0 * family.p - s) * (form * form)) +
           (1.0 / s) * (avi::power(t, 1.0 - s) * p[d]);
  }
};

TEST(Htvi, GenericMachineryOfOrderZeroGivesTheExplicitUpdate) {
  constexpr int d = 3;
  const CorrelatedQuartic f(d, 0.9);
  for (const auto& family : families) {
    ExtendedPoint z = avi::bregman_start(family, f, Eigen::Vector3d(1.4, 0.7, 2.0));
    z.t = 1.1;
    avi::State<d + 1> start;
    for (int i = 0; i < d; ++i)
      start.q[i] = z.q[i], start.p[i] = z.r[i];
    start.q[d] = z.t;
    start.p[d] = z.r_t;
    const auto problem = avi::poincare<d + 1>(Extended<d>{family}, start);
    const double h = step(family);
    // Every rule gives the same integrator when the Taylor order is 0.
    for (const auto& rule : {avi::rectangle_left(), avi::simpson(), avi::gauss(3)}) {
      auto method = avi::type2<0, experiment::Printed>(problem, rule);
      auto generic = start;
      auto explicit_update = z;
      for (int k = 0; k < 20; ++k) {
        const auto report = method.step(generic, h);
        ASSERT_EQ(report.outcome, avi::Outcome::ok) << rule.name;
        experiment::htvi_printed_step(family, f, h, explicit_update);
      }
      const auto expect_equal = [&](double a, double b) {
        EXPECT_NEAR(a / b, 1.0, 1e-13) << rule.name << family.p << " " << family.p_ring;
      };
      for (int i = 0; i < d; ++i) {
        expect_equal(generic.q[i], explicit_update.q[i]);
        expect_equal(generic.p[i], explicit_update.r[i]);
      }
      expect_equal(generic.q[d], explicit_update.t);
      expect_equal(generic.p[d], explicit_update.r_t);
    }
  }
}

}  // namespace bregman_equivalence_test
