#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/poincare.hpp"

#include <gtest/gtest.h>

#include <cmath>

// Monitors that are of no use where a run starts: each ends as a named outcome, and the state stays.

namespace bad_monitor_test {

using avi::Kepler;
using avi::Outcome;

/// |q - q_0|^2 about the start (1/2, 0) of an orbit of eccentricity 1/2.
template <class Q>
auto away(const Q& q) {
  return (q[0] - 0.5) * (q[0] - 0.5) + q[1] * q[1];
}
struct Vanishing {
  template <class Q>
  auto operator()(const Q& q) const {
    return away(q);
  }
};
struct Infinite {
  template <class Q>
  auto operator()(const Q& q) const {
    return 1.0 / away(q);
  }
};
struct NotANumber {
  template <class Q>
  auto operator()(const Q& q) const {
    using std::sqrt;
    return sqrt(q[0] - 2.0);
  }
};
struct Negative {
  template <class Q>
  auto operator()(const Q& q) const {
    return -1.0 - away(q);
  }
};

template <class G>
void expect(Outcome outcome, const G& monitor) {
  const avi::State<2> start = Kepler::pericentre(0.5);
  for (const int order : {2, 8, 16}) {
    auto method = avi::collocation(poincare(Kepler(), start, monitor), order);
    avi::State<2> z = start;
    const avi::Run run = integrate(method, z, 0.1, avi::Until{.time = 1.0});
    EXPECT_EQ(run.outcome, outcome) << order << ": " << run.message;
    EXPECT_NE(run.message.find(std::string(avi::name(outcome))), std::string::npos) << run.message;
    EXPECT_EQ(run.steps, 0);
    EXPECT_EQ(z.q, start.q);
    EXPECT_EQ(z.p, start.p);
    EXPECT_EQ(z.t, start.t);
  }
}

TEST(BadMonitor, ThatVanishesAtTheStartLetsNoTimePass) { expect(Outcome::bad_monitor, Vanishing()); }
TEST(BadMonitor, ThatIsInfiniteAtTheStartIsNotFinite) { expect(Outcome::non_finite, Infinite()); }
TEST(BadMonitor, ThatIsNotANumberIsNotFinite) { expect(Outcome::non_finite, NotANumber()); }
TEST(BadMonitor, IsNotBlamedForAStepOfNoLength) {
  const auto distance = [](const auto& q) { return q[0] * q[0] + q[1] * q[1]; };
  const auto start = Kepler::pericentre(0.5);
  for (const double h : {0.0, 5e-324, -5e-324, 1e-320, 1e-300}) {
    auto method = avi::collocation(avi::poincare<2>(Kepler{}, start, distance), 8);
    auto z = start;
    EXPECT_EQ(method.step(z, h).outcome, Outcome::ok) << h;
    EXPECT_LE(avi::largest_entry(z.q - start.q) + avi::largest_entry(z.p - start.p) + std::abs(z.t),
              10.0 * std::abs(h))
        << h;
    auto vanishing = avi::collocation(avi::poincare<2>(Kepler{}, start, Vanishing{}), 8);
    EXPECT_NE(vanishing.step(z, h == 0.0 ? 1e-300 : h).outcome, Outcome::ok) << h;
  }
}

TEST(BadMonitor, ThatIsNegativeLetsNoTimePass) { expect(Outcome::bad_monitor, Negative()); }

}  // namespace bad_monitor_test
