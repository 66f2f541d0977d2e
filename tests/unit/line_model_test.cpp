#include "avi/optim/line_model.hpp"

#include <gtest/gtest.h>

using avi::LineModel, avi::LinePoint;

namespace line_model_test {

/// a + b t + c t^2 + d t^3.
struct Cubic {
  double a, b, c, d;
  LinePoint operator()(double t) const {
    return {a + t * (b + t * (c + t * d)), b + t * (2.0 * c + 3.0 * t * d)};
  }
};

TEST(LineModel, FindsTheMinimumOfAParabola) {
  const Cubic phi{3.0, -4.0, 2.0, 0.0};  // minimum at 1
  for (double h : {0.11, 0.5, 1.0, 2.0, 20.0}) {
    const LineModel model(phi(0.0), phi(h), h, 1e-13);
    EXPECT_NEAR(model.r * h, 1.0, 1e-12);
    EXPECT_TRUE(model.trusted()) << h;
    EXPECT_EQ(model.defect, 0.0);
    EXPECT_FALSE(model.blind());
  }
  EXPECT_FALSE(LineModel(phi(0.0), phi(0.09), 0.09, 1e-14).trusted());  // r > 10
  EXPECT_FALSE(LineModel(phi(0.0), phi(60.0), 60.0, 1e-14).trusted());  // r < 0.02
}

TEST(LineModel, ItsDefectIsTheCubicTerm) {
  const double h = 0.5, d = 0.3;
  const Cubic phi{1.0, -2.0, 1.0, d};
  const LineModel model(phi(0.0), phi(h), h, 0.0);
  // e = -d h^3 / 2; the slope at r h is then wrong by 6 (e/h) r (r - 1).
  EXPECT_NEAR(model.defect, 0.5 * d * h * h / 2.0, 1e-15);
  EXPECT_NEAR(phi(model.r * h).slope, -3.0 * d * h * h * model.r * (1.0 - model.r), 1e-14);
  EXPECT_FALSE(model.trusted());
}

TEST(LineModel, RoundingIsNoDefect) {
  const Cubic phi{1e8, -2.0, 1.0, 0.0};
  LinePoint end = phi(0.5);
  end.value += 1e-7;
  EXPECT_EQ(LineModel(phi(0.0), end, 0.5, 2e-7).defect, 0.0);
  EXPECT_NEAR(LineModel(phi(0.0), end, 0.5, 0.0).trapezium(), 1e-7, 2e-8);
  EXPECT_GT(LineModel(phi(0.0), end, 0.5, 0.0).defect, 0.0);
}

TEST(LineModel, SaysWhereRoundingWouldHideADefect) {
  // h max |phi'| = 0.5: the slope at r h = 2 h may be wrong by 6 (noise / 0.5) 2 (2 - 1), which is 0.04 at
  // noise 1 / 600.
  const Cubic phi{3.0, -1.0, 0.5, 0.0};
  EXPECT_TRUE(LineModel(phi(0.0), phi(0.5), 0.5, 1.01 / 600.0).blind());
  EXPECT_FALSE(LineModel(phi(0.0), phi(0.5), 0.5, 0.99 / 600.0).blind());
}

TEST(LineModel, TheCubicHasTheMinimumBetween) {
  const Cubic phi{0.0, -1.0, 0.0, 1.0 / 3.0};  // slope t^2 - 1, minimum at 1
  EXPECT_NEAR(LineModel(phi(0.0), phi(1.7), 1.7, 0.0).cubic() * 1.7, 1.0, 1e-12);
  EXPECT_EQ(LineModel({0.0, -1.0}, {-1.0, -1.0}, 1.0, 0.0).cubic(), 0.5);  // a straight line
  EXPECT_EQ(LineModel({0.0, -1.0}, {1000.0, 3000.0}, 1.0, 0.0).cubic(), 0.05) << "0.018, too near";
  EXPECT_EQ(LineModel({0.0, -1.0}, {-1.0, 0.0}, 1.0, 0.0).cubic(), 0.95) << "1, the trial itself";
}

TEST(LineModel, GoesFurtherWhereItStillFalls) {
  EXPECT_EQ(LineModel({0.0, -1.0}, {-1.0, -1.0}, 1.0, 0.0).beyond(), 5.0);
  EXPECT_EQ(LineModel({0.0, -1.0}, {-0.5, -0.5}, 1.0, 0.0).beyond(), 2.0);
  EXPECT_EQ(LineModel({0.0, -1.0}, {-1.0, -0.999}, 1.0, 0.0).beyond(), 10.0);
}

TEST(LineMisses, TellsABendFromNoise) {
  const auto root = [](double t) {
    const double value = std::sqrt(1.0 + (t - 3.0) * (t - 3.0));
    return LinePoint{value, (t - 3.0) / value};
  };
  avi::LineMisses bend, noise;
  for (double h = 1e5; h > 15.0; h *= 0.1) {
    bend.add(LineModel(root(0.0), root(h), h, 0.0));
    noise.add(LineModel({0.0, -1.0}, {1e3 - h, -1.0}, h, 0.0));
  }
  const LineModel at_bend(root(0.0), root(10.0), 10.0, 0.0);
  EXPECT_TRUE(bend.bends(at_bend, 100.0, 1e-6));
  EXPECT_FALSE(bend.bends(at_bend, 0.01, 1e-6)) << "noise of that size hides nothing";
  EXPECT_FALSE(bend.bends(at_bend, 100.0, 1e3)) << "rounding may be larger than that";
  EXPECT_FALSE(noise.bends(LineModel({0.0, -1.0}, {990.0, -1.0}, 10.0, 0.0), 100.0, 1e-6));
  EXPECT_NEAR(noise.size(), 1e3, 1e-9);
}

}  // namespace line_model_test
