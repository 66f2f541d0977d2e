#include "avi/optim/minimise.hpp"
#include "common/rules/update_rules.hpp"
#include "refusal.hpp"
#include "unit/objectives.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace starting_point_test {

using avi::VectorX;

VectorX taken(const avi::StartingPoint& x0) { return x0.vector(); }

TEST(StartingPoint, IsAVectorOfAnyKind) {
  const VectorX x = VectorX::LinSpaced(3, 1.0, 3.0);
  const std::vector<double> numbers{1.0, 2.0, 3.0};
  const double plain[] = {1.0, 2.0, 3.0};
  EXPECT_EQ(taken(x), x);
  EXPECT_EQ(taken({1.0, 2.0, 3.0}), x);
  EXPECT_EQ(taken({1, 2, 3}), x);
  EXPECT_EQ(taken(numbers), x);
  EXPECT_EQ(taken(std::array{1.0, 2.0, 3.0}), x);
  EXPECT_EQ(taken(plain), x);
  EXPECT_EQ(taken(std::span(numbers)), x);
  EXPECT_EQ(taken(Eigen::Vector3d(1.0, 2.0, 3.0)), x);
  EXPECT_EQ(taken(Eigen::RowVector3d(1.0, 2.0, 3.0)), x);
  EXPECT_EQ(taken(2.0 * x - x), x);
  EXPECT_EQ(taken(Eigen::Map<const VectorX>(plain, 3)), x);
  EXPECT_EQ(taken({5.0}), VectorX::Constant(1, 5.0)) << "one number is no size";
}

TEST(StartingPoint, OfAVectorIsNoCopy) {
  const VectorX x = VectorX::Ones(3);
  const avi::StartingPoint start(x);
  EXPECT_EQ(&start.vector(), &x);
}

TEST(StartingPoint, ServesBothLoops) {
  const auto valley = [](const auto& x) {
    const auto a = x[1] - x[0] * x[0], b = 1.0 - x[0];
    return 100.0 * a * a + b * b;
  };
  const auto run = avi::minimise(valley, {-1.2, 1.0}, {.relative = 1e-10});
  EXPECT_TRUE(run.ok()) << run.message;
  EXPECT_NEAR(run.last.x[1], 1.0, 1e-7);
  EXPECT_EQ(avi::minimise(valley, std::vector{-1.2, 1.0}, {.relative = 1e-10}).iterations, run.iterations);
  const auto descent =
      avi::run_updates(objectives::bowl, experiment::GradientDescent{.h = 0.1}, {1.0, 1.0}, {.delta = 1e-4});
  EXPECT_TRUE(descent.ok()) << descent.message;
  EXPECT_FALSE(avi::minimise(valley, {-1.2, 1.0}, {.iterations = 1}).ok());
}

TEST(StartingPoint, IsNoMatrixOfWhichOneColumnWouldBeTaken) {
  const Eigen::MatrixXd six = Eigen::MatrixXd::Ones(2, 3);
  EXPECT_EQ(refusal([&] { (void)avi::minimise(objectives::bowl, six); }),
            "Number of columns of x0 is 3; it must be 1.");
  EXPECT_EQ(taken(Eigen::MatrixXd(six.col(1))), VectorX::Ones(2));
  EXPECT_EQ(taken(six.row(1)), VectorX::Ones(3));
}

TEST(StartingPoint, OfNoNumbersIsRefused) {
  EXPECT_EQ(refusal([] { (void)avi::minimise(objectives::bowl, std::vector<double>{}); }),
            "Size of x0 is 0; it must be at least 1.");
}

}  // namespace starting_point_test
