#include "avi/optim/run_updates.hpp"
#include "common/rules/update_rules.hpp"

#include <gtest/gtest.h>

#include <vector>

using avi::run_updates, avi::VectorX;

namespace optimisers_test {

/// f = (x^2 + 4 y^2) / 2.
double ellipse(const VectorX& x, VectorX& g) {
  g = VectorX(x.cwiseProduct(Eigen::Vector2d(1.0, 4.0)));
  return 0.5 * avi::dot(x, g);
}

/// The first n iterates of a method from (3, 1), both coordinates in one list.
std::vector<double> path(const auto& method, long n) {
  std::vector<double> points;
  run_updates(ellipse, method, Eigen::Vector2d(3.0, 1.0), {.delta = 0.0, .iterations = n},
              [&](const avi::Iterate& at, long k, long) {
                if (k > 0) points.insert(points.end(), {at.x[0], at.x[1]});
              });
  return points;
}

void expect_path(const std::vector<double>& seen, const std::vector<double>& expected) {
  ASSERT_EQ(seen.size(), expected.size());
  for (std::size_t i = 0; i < seen.size(); ++i)
    EXPECT_NEAR(seen[i], expected[i], 1e-12) << "entry " << i;
}

// Expected values worked out by hand from the definitions.

TEST(GradientDescent, FirstSteps) {
  expect_path(path(experiment::GradientDescent{.h = 0.1}, 2), {2.7, 0.6, 2.43, 0.36});
}

TEST(Nag, FirstSteps) {
  // y_1 = x_1 + (x_1 - x_0)/4 = (2.625, 0.5); x_2 = (2.3625, 0.3); y_2 = x_2 + 0.4 (x_2 - x_1).
  const double y_x = 2.3625 + 0.4 * (2.3625 - 2.7), y_y = 0.3 + 0.4 * (0.3 - 0.6);
  expect_path(path(experiment::Nag{.h = 0.1}, 3), {2.7, 0.6, 2.3625, 0.3, 0.9 * y_x, 0.6 * y_y});
  // With k = 1 at the first update y_1 = x_1 = (2.7, 0.6), x_2 = (2.43, 0.36), y_2 = x_2 + (x_2 - x_1)/4.
  const double later_x = 2.43 + 0.25 * (2.43 - 2.7), later_y = 0.36 + 0.25 * (0.36 - 0.6);
  expect_path(path(experiment::Nag{.h = 0.1, .first = 1.0}, 3),
              {2.7, 0.6, 2.43, 0.36, 0.9 * later_x, 0.6 * later_y});
}

TEST(Adam, FirstSteps) {
  // After one step the corrected moments are g and g^2: a step of `rate` in each sign.
  const double x1 = 3.0 - 0.1, y1 = 1.0 - 0.1;
  const auto next = [](double x, double g1, double g2) {
    const double m = 0.9 * 0.1 * g1 + 0.1 * g2, v = 0.999 * 0.001 * g1 * g1 + 0.001 * g2 * g2;
    return x - 0.1 * (m / (1.0 - 0.81)) / std::sqrt(v / (1.0 - 0.998001));
  };
  expect_path(path(experiment::Adam{.rate = 0.1, .epsilon = 0.0}, 2),
              {x1, y1, next(x1, 3.0, x1), next(y1, 4.0, 4.0 * y1)});
}

TEST(AdaGrad, FirstSteps) {
  const double x1 = 3.0 - 0.5 * 3.0 / 3.25, y1 = 1.0 - 0.5 * 4.0 / 4.25;
  expect_path(path(experiment::AdaGrad{.rate = 0.5, .epsilon = 0.25}, 2),
              {x1, y1, x1 - 0.5 * x1 / (std::sqrt(9.0 + x1 * x1) + 0.25),
               y1 - 0.5 * 4.0 * y1 / (std::sqrt(16.0 + 16.0 * y1 * y1) + 0.25)});
}

TEST(RmsProp, FirstSteps) {
  const double v = 0.1 * 9.0, w = 0.1 * 16.0;
  const double x1 = 3.0 - 0.1 * 3.0 / std::sqrt(v + 0.25), y1 = 1.0 - 0.1 * 4.0 / std::sqrt(w + 0.25);
  expect_path(path(experiment::RmsProp{.rate = 0.1, .rho = 0.9, .epsilon = 0.25}, 2),
              {x1, y1, x1 - 0.1 * x1 / std::sqrt(0.9 * v + 0.1 * x1 * x1 + 0.25),
               y1 - 0.1 * 4.0 * y1 / std::sqrt(0.9 * w + 1.6 * y1 * y1 + 0.25)});
}

TEST(TrustRegion, ShrinksRefusedStepsAndGrowsGoodOnes) {
  // From (3, 1): g = (3, 4), |g| = 5, f = 6.5. Delta = 1 gives f = 2.5 at (2.4, 0.2): 2.5 + 0.4 = 2.96, ratio
  // (6.5 - 2.96) / 5 = 0.708, accepted, not expanded.
  expect_path(path(experiment::TrustRegion{}, 1), {2.4, 0.2});
  // A ratio of 0.708 grows the radius once `expand` is below it: the second trial has length 2, is refused
  // (ratio 0.49), and 1.8 is taken.
  const auto grown = path(experiment::TrustRegion{.expand = 0.7}, 2);
  EXPECT_NEAR(std::hypot(grown[2] - grown[0], grown[3] - grown[1]), 1.8, 1e-12);
  // Delta = 2 from (3, 1): f at (1.8, -0.6) = 2.34, ratio 0.416 refused; 1.8: (1.92, -0.44), 2.2304, 0.4744
  // refused; 1.62: (2.028, -0.296), f = 2.231624, ratio 0.527 accepted.
  long values = 0;
  const auto run = run_updates(ellipse, experiment::TrustRegion{.radius = 2.0}, Eigen::Vector2d(3.0, 1.0),
                               {.iterations = 1}, [&](const auto& at, long, long) { values += at.x.size(); });
  expect_path({run.last.x[0], run.last.x[1]}, {2.028, -0.296});
  EXPECT_EQ(run.function_evaluations, 1 + 3 + 1);
}

TEST(Optimisers, HaveThePublishedDefaults) {
  const experiment::Adam adam;
  EXPECT_EQ((std::vector{adam.rate, adam.beta_1, adam.beta_2, adam.epsilon}),
            (std::vector{1e-3, 0.9, 0.999, 1e-8}));
  const experiment::RmsProp rms;
  EXPECT_EQ((std::vector{rms.rate, rms.rho, rms.epsilon}), (std::vector{1e-2, 0.9, 1e-8}));
  const experiment::TrustRegion region;
  EXPECT_EQ((std::vector{region.radius, region.accept, region.expand, region.shrink, region.grow}),
            (std::vector{1.0, 0.5, 0.75, 0.9, 2.0}));
  EXPECT_EQ(region.trials, 1000);
  EXPECT_EQ((std::vector{experiment::GradientDescent{}.h, experiment::Nag{}.h}), (std::vector{1e-3, 1e-3}));
  const experiment::AdaGrad ada;
  EXPECT_EQ((std::vector{ada.rate, ada.epsilon}), (std::vector{1.0, 1e-8}));
}

TEST(TrustRegion, ThresholdsAreTheirOwnLimits) {
  // On a line f falls by as much as the model says: ratio = 1 for every step, up to rounding that (0.5, 0.25)
  // does not have. A ratio that equals the threshold is not above it.
  const auto line = [](const VectorX& x, VectorX& g) {
    g = VectorX::Ones(1);
    return x[0];
  };
  const auto length_of_second = [&](double expand) {
    std::vector<double> seen{0.5};
    run_updates(line, experiment::TrustRegion{.radius = 0.25, .expand = expand}, VectorX::Constant(1, 0.5),
                {.delta = 0.0, .iterations = 2}, [&](const avi::Iterate& at, long k, long) {
                  if (k > 0) seen.push_back(at.x[0]);
                });
    return seen.at(1) - seen.at(2);
  };
  EXPECT_EQ(length_of_second(1.0), 0.25) << "1 is not above 1";
  EXPECT_EQ(length_of_second(0.99), 0.5);
}

TEST(Optimisers, TakeParametersAtTheEndsOfTheirRanges) {
  const avi::Iterate first{.x = VectorX::Ones(2), .gradient = VectorX::Ones(2)};
  EXPECT_NO_THROW(experiment::Adam({.beta_1 = 0.0, .beta_2 = 0.0, .epsilon = 0.0}).start(first));
  EXPECT_NO_THROW(experiment::AdaGrad{.epsilon = 0.0}.start(first));
  EXPECT_NO_THROW((experiment::RmsProp{.rho = 0.0, .epsilon = 0.0}.start(first)));
  EXPECT_NO_THROW(
      (experiment::TrustRegion{.accept = 0.0, .expand = 0.0, .grow = 1.0, .trials = 1}.start(first)));
}

TEST(TrustRegion, EndsWhereNothingMoves) {
  const auto run = run_updates(ellipse, experiment::TrustRegion{}, VectorX::Zero(2));
  EXPECT_TRUE(run.ok());
  EXPECT_EQ(run.iterations, 1);
  const experiment::TrustRegion once{.radius = 2.0, .trials = 2};  // the third would be taken
  EXPECT_EQ(run_updates(ellipse, once, Eigen::Vector2d(3.0, 1.0)).outcome, avi::Outcome::not_converged);
}

}  // namespace optimisers_test
