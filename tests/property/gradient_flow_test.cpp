#include "avi/bregman/bregman_htvi.hpp"
#include "avi/optim/run_updates.hpp"

#include <gtest/gtest.h>

#include <algorithm>

// The paper's remark that a gradient flow near the minimum makes the rate of the p/t clock exponential.

using avi::VectorX;

namespace gradient_flow_test {

constexpr double L = 100.0;  // the largest eigenvalue; the least is 1
constexpr long cap = 5000;

double quadratic(const VectorX& x, VectorX& g) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    g[i] = std::pow(L, static_cast<double>(i) / static_cast<double>(x.size() - 1)) * x[i];
  return 0.5 * avi::dot(x, g);
}

/// Direct p = 2 until |grad f| <= level |grad f(x_0)|, then gradient descent of step 1 / L; or, with `both`,
/// an update of each in turn.
struct Switch {
  avi::BregmanHtvi momentum;
  double level = 0.0;
  bool both = false;

  struct State {
    avi::BregmanHtvi::State momentum;
    double first;
    bool switched = false;
  };
  State start(const avi::Iterate& at) const { return {momentum.start(at), avi::norm(at.gradient)}; }
  template <class F>
  avi::Outcome update(State& state, avi::Iterate& now, F& f) const {
    state.switched = state.switched || avi::norm(now.gradient) <= level * state.first;
    avi::Outcome outcome = avi::Outcome::ok;
    if (!state.switched) outcome = momentum.update(state.momentum, now, f);
    if (state.switched || both) now.x -= now.gradient / L;
    now.evaluated = false;
    return outcome;
  }
};

/// Gradients until |grad f| <= delta |grad f(x_0)|, at most the cap.
long gradients(const Switch& rule, double delta) {
  VectorX x0 = VectorX::Ones(50), g(50);
  quadratic(x0, g);
  const double first = avi::norm(g);
  long count = cap;
  (void)avi::run_updates(quadratic, rule, x0, {.delta = 0.0, .iterations = cap},
                         [&](const avi::Iterate& at, long, long spent) {
                           if (avi::norm(at.gradient) > delta * first) return spent < cap;
                           count = spent;
                           return false;
                         });
  return count;
}

/// At the best of ten steps.
long best(double level, bool both, double delta) {
  long least = cap;
  for (int k = 0; k < 10; ++k) {
    const avi::BregmanHtvi momentum{.family = avi::BregmanFamily::direct(2.0),
                                    .h = std::pow(10.0, -1.8 + 0.2 * k),
                                    .from = {.momentum = 0.0}};
    least = std::min(least, gradients({momentum, level, both}, delta));
  }
  return least;
}

TEST(GradientFlow, MakesTheRateOfThePtClockExponential) {
  EXPECT_EQ(best(0.0, false, 1e-6), cap);  // alone it never comes there
  const long added[] = {best(0.0, true, 1e-6), best(0.0, true, 1e-10)};
  const long switched[] = {best(1e-2, false, 1e-6), best(1e-2, false, 1e-10)};
  const long descent[] = {best(1.0, false, 1e-6), best(1.0, false, 1e-10)};
  std::printf("to 1e-6 and 1e-10: added %ld %ld, switched %ld %ld, descent alone %ld %ld\n", added[0],
              added[1], switched[0], switched[1], descent[0], descent[1]);
  EXPECT_LE(added[0], 900);      // measured 447
  EXPECT_LE(added[1], 3600);     // measured 1791
  EXPECT_LE(switched[0], 1150);  // measured 577
  EXPECT_LE(switched[1], 2700);  // measured 1367
  // The rate is that of gradient descent, 1 - 1/L for an update: 921 for four decades.
  const double four = L * std::log(1e4);
  EXPECT_NEAR(static_cast<double>(switched[1] - switched[0]), four, 0.3 * four);  // measured 790
  EXPECT_NEAR(static_cast<double>(descent[1] - descent[0]), four, 0.03 * four);   // measured 906
}

}  // namespace gradient_flow_test
