#include "avi/avi.hpp"
#include "common/problems/chain.hpp"
#include "distance.hpp"
#include "rate.hpp"

#include <gtest/gtest.h>

#include <type_traits>

using avi::Kepler, avi::Outcome, avi::State;

namespace sweeps_test {

/// 1/g = 1 + |q|^2 + |p|^2.
const auto both_rate = [](const auto& q, const auto& p) {
  auto sum = 1.0 + q[0] * q[0] + p[0] * p[0];
  for (Eigen::Index i = 1; i < q.size(); ++i)
    sum += q[i] * q[i] + p[i] * p[i];
  return 1.0 / sum;
};

/// The chain with a gradient that is not its own: one more force, of 1/64 on every mass.
struct Pushed : experiment::Chain {
  template <class S, int n>
  avi::Vector<S, n> d_dq(const avi::Vector<S, n>& q, const avi::Vector<S, n>& p) const {
    return Chain::d_dq(q, p) - avi::Vector<S, n>::Constant(q.size(), S(0.015625));
  }
};

// Where n is known to the compiler, and where it is not.
TEST(Sweeps, TakesSuppliedGradientsOfManyDegreesOfFreedom) {
  const auto plucked = experiment::Chain::plucked(9);
  const State<9> start{.q = plucked.q, .p = 0.5 * plucked.q.reverse()};
  const double away =
      0.125 - experiment::Chain{}(start.q, start.p);  // p^t off the shell, where all terms count
  const auto compare = [&](const auto& monitor) {
    using G = std::decay_t<decltype(monitor)>;
    using H = avi::Automatic<experiment::Chain>;
    State<9> a = start, b = start;
    auto supplied = avi::collocation(avi::Poincare<9, experiment::Chain, G>({}, monitor, away), 12);
    auto automatic = avi::collocation(avi::Poincare<9, H, G>({}, monitor, away), 12);
    ASSERT_EQ(avi::integrate(supplied, a, 0.3, {.steps = 40}).outcome, Outcome::ok);
    ASSERT_EQ(avi::integrate(automatic, b, 0.3, {.steps = 40}).outcome, Outcome::ok);
    EXPECT_LT((a.q - b.q).norm() + (a.p - b.p).norm(), 5e-15);
    EXPECT_NEAR(a.t, b.t, 4e-15);
    EXPECT_GT((a.q - start.q).norm(), 0.1);
    const auto end = [&](auto problem, auto z) {
      auto method = avi::collocation(problem, 12);
      EXPECT_EQ(avi::integrate(method, z, 0.3, {.steps = 40}).outcome, Outcome::ok);
      return State<9>{.q = z.q, .p = z.p, .t = z.t};
    };
    const State<avi::dynamic> same{.q = start.q, .p = start.p};
    const auto free = end(avi::Poincare<avi::dynamic, experiment::Chain, G>({}, monitor, away, 9), same);
    EXPECT_LT(distance(a, free), 1e-14);
    const auto pushed = end(avi::Poincare<9, Pushed, G>({}, monitor, away), start),
               pushed_free = end(avi::Poincare<avi::dynamic, Pushed, G>({}, monitor, away, 9), same);
    EXPECT_LT(distance(pushed, pushed_free), 1e-14);
    EXPECT_GT(distance(a, pushed), 0.01) << "a supplied gradient is used";
  };
  compare(avi::Unit{});
  compare(Rate{});
  compare(both_rate);
}

TEST(Sweeps, ThrowsAwayWhatItBeganInVain) {
  // A step is begun while the one before is solved. Where the next step is another one, nothing of it stays.
  auto method = avi::collocation(avi::poincare(Kepler{}, Kepler::pericentre(0.7), avi::Gamma{0.75}), 16);
  State<2> z = Kepler::pericentre(0.7);
  int k = 0;
  for (const double h :
       {0.9, 0.9, 0.9, 0.4, 0.4, -0.9, -0.9, -0.9, 0.9, 0.05, 0.9, 0.9, 1.0, 1.0, -0.1, 1.0}) {
    State<2> alone = z;
    auto fresh = avi::collocation(method.problem(), 16);
    ASSERT_EQ(fresh.step(alone, h).outcome, Outcome::ok) << k;
    if (++k % 5 == 0) {  // another state in between
      State<2> other = z;
      other.q[0] += 0.125;
      ASSERT_EQ(method.step(other, h).outcome, Outcome::ok) << k;
    }
    ASSERT_EQ(method.step(z, h).outcome, Outcome::ok) << k;
    EXPECT_LT(distance(z, alone), 8e-15) << k;
  }
}

}  // namespace sweeps_test
