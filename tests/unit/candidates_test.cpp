#include "src/choice/candidates.hpp"

#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace candidates_test {

using avi::VectorX, avi::detail::Candidate, avi::detail::infinity;

/// The menu for an orbit, and what it was made of.
struct Menu {
  avi::detail::OrbitQuestion question;
  avi::detail::PointField field;
  VectorX start, slope, metric;
  double energy;
  avi::detail::Sketch sketch;
  avi::Choice constants;
  std::vector<Candidate> candidates;

  template <class H, int n>
  Menu(const H& hamiltonian, const avi::State<n>& z, double span, const avi::SolveOptions& options = {})
      : question(avi::detail::question_of(hamiltonian, z, span, 1e-8, options)),
        field(question.graph, question.energy, {}), start(2 * n), slope(2 * n),
        metric(((start << z.q, z.p).finished(), field.metric(start))), energy(field(start, slope)),
        sketch(field, start, span, metric) {
    avi::detail::Resting resting;
    double kinetic = 0.0;
    for (const auto& sample : sketch.samples) {
      VectorX rest = sample.z, falling(2 * n);
      rest.tail(n).setZero();
      resting.energy.push_back(field(rest, falling));
      resting.forces.insert(resting.forces.end(), falling.begin() + n, falling.end());
      kinetic += sample.h * (sample.energy - resting.energy.back()) / sketch.time;
    }
    constants.kinetic = kinetic;
    constants.accelerations = avi::detail::accelerations(sketch, metric, n);
    const double radians = sketch.radians / sketch.time * span;
    avi::detail::Bends bends(question.graph, question.energy, question.timed);
    bends.measure(sketch);
    candidates = avi::detail::candidates(question, energy, sketch, bends, radians, resting, metric, constants,
                                         field.operations());
  }
  [[nodiscard]] std::string names() const {
    std::string all;
    for (const Candidate& it : candidates)
      all += (all.empty() ? "" : " ") + it.name;
    return all;
  }
};

/// What the menu says of each candidate, against the candidate itself.
void expect_what_it_is(Menu& menu) {
  const VectorX& metric = menu.metric;
  const Eigen::Index n = metric.size();
  VectorX strength = VectorX::Zero(2 * n);  // largest derivative of H by each entry
  for (const auto& sample : menu.sketch.samples) {
    strength.head(n) = strength.head(n).cwiseMax(sample.slope.tail(n).cwiseAbs());
    strength.tail(n) = strength.tail(n).cwiseMax(sample.slope.head(n).cwiseAbs());
  }
  const double rounding = std::numeric_limits<double>::epsilon() *
                          std::max(std::abs(menu.energy), std::abs(menu.constants.kinetic));
  double outlook = 0.0;
  for (Candidate& it : menu.candidates) {
    const avi::Formula g = it.formula();
    avi::detail::RecordedFormula<double> slopes{avi::Recording(g.graph(), g.node()).value_and_gradient()};
    double fictive = 0.0, longest = 0.0, steepest = 0.0;
    for (const auto& sample : menu.sketch.samples) {
      const double rate = it.rate_at(sample.z.data());
      fictive += sample.h / rate;
      longest = std::max(longest, rate * sample.frequency);
      std::copy(sample.z.begin(), sample.z.end(), slopes.room.arguments());
      slopes.program.run(slopes.room);
      for (int i = 0; i < 2 * n; ++i)
        steepest = std::max(steepest, std::abs(slopes.partial(i)) / (rate * strength[i]));
    }
    // That of the poles is put together of its parts before its formula is made, and how fast it changes
    // counts, too.
    const bool exact = it.name != "poles";
    EXPECT_NEAR(it.fictive / fictive, 1.0, exact ? 1e-12 : 0.1) << it.name;
    EXPECT_NEAR(exact ? it.longest / longest : std::min(it.longest / longest, 1.0), 1.0, exact ? 1e-12 : 0.1)
        << it.name;
    EXPECT_NEAR(it.noise, rounding * steepest, (exact ? 1e-9 : 1.0) * it.noise) << it.name;
    EXPECT_NEAR(it.outlook / (it.fictive * it.longest) / it.price(), 1.0, 0.25) << it.name;
    EXPECT_GE(it.outlook, outlook) << it.name << ", the most promising one first";
    outlook = it.outlook;
  }
}

TEST(Candidates, AreWhatTheMenuSaysOfThem) {
  Menu round(avi::Kepler{}, avi::Kepler::pericentre(0.1), 100.0);
  EXPECT_EQ(round.names(), "fixed energy^1.5 energy");
  expect_what_it_is(round);
  Menu eccentric(avi::Kepler{}, avi::Kepler::pericentre(0.9), 100.0);
  EXPECT_EQ(eccentric.names(), "energy^1.5 energy fixed");
  expect_what_it_is(eccentric);
  Menu nearly_a_circle(avi::Kepler{}, avi::Kepler::pericentre(0.01), 100.0);
  EXPECT_EQ(nearly_a_circle.names().substr(0, 5), "fixed");
  for (const Candidate& it : nearly_a_circle.candidates)
    EXPECT_TRUE(it.fixed() || it.outlook == infinity) << it.name << ", which hardly changes";
  Menu near(avi::Kepler{}, avi::Kepler::pericentre(0.9999), 100.0, {.monitor = "poles"});
  EXPECT_NE(near.names().find("poles"), std::string::npos) << near.names();
  expect_what_it_is(near);
}

TEST(Candidates, AreDearerWhereThereAreMorePoles) {
  const auto centres = [](const auto& q, const auto& p) {
    auto sum = 0.5 * (p[0] * p[0] + p[1] * p[1]);
    for (int k = 0; k < 4; ++k) {
      const auto x = q[0] - 0.8 * k, y = q[1] - 0.1 * k * k;
      sum = sum - 1.0 / sqrt(x * x + y * y);
    }
    return sum;
  };
  Menu menu(centres, avi::State<2>{.q = {1.0, 1.0}, .p = {-0.3, -0.5}}, 100.0, {.monitor = "poles"});
  EXPECT_NE(menu.names().find("poles"), std::string::npos) << menu.names();
  expect_what_it_is(menu);
}

TEST(Accelerations, AreOfTheSizeOfOneOnTheWay) {
  const Menu menu(avi::Kepler{}, avi::Kepler::pericentre(0.9), 100.0);
  const Eigen::Map<const VectorX> weight(menu.constants.accelerations.data(), 2);
  double mean = 0.0;
  VectorX low = menu.start, high = menu.start;
  for (const auto& sample : menu.sketch.samples) {
    mean += sample.h / menu.sketch.time * std::sqrt(weight.cwiseProduct(sample.slope.tail(2)).norm());
    low = low.cwiseMin(sample.z), high = high.cwiseMax(sample.z);
  }
  EXPECT_NEAR(mean, 1.0, 1e-14);
  EXPECT_NEAR(weight[0] * (high[0] - low[0]), weight[1] * (high[1] - low[1]), 1e-14) << "of equal masses";
}

TEST(Accelerations, MakeTheMonitorOfTheirName) {
  const avi::Formula h = avi::Formula::of_phase<2>(avi::Kepler{});
  const avi::Formula g = monitor_of({.name = "acceleration", .accelerations = {2.0, 3.0}}, h, -0.5);
  const Eigen::Vector2d q(0.6, 0.8), p(0.1, 1.0);  // where dH/dq = q
  EXPECT_NEAR(g(q, p), std::pow(1.0 + 1.2 * 1.2 + 2.4 * 2.4, -0.375), 1e-15);
}

}  // namespace candidates_test
