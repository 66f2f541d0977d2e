#include "src/minimise/diagonal_mass.hpp"

#include <gtest/gtest.h>

using avi::VectorX;

namespace diagonal_mass_test {

struct Pair {
  VectorX s, y;
  double rho;
};

Pair pair(const VectorX& s, const VectorX& curvatures) {
  const VectorX y = s.cwiseProduct(curvatures);
  return {s, y, 1.0 / s.dot(y)};
}

TEST(DiagonalMass, IsTheDiagonalOfTheBfgsFormula) {
  constexpr Eigen::Index n = 11;
  avi::DiagonalMass mass(n);
  VectorX expected;
  for (int lesson = 0; lesson < 5; ++lesson) {
    VectorX s(n);
    for (Eigen::Index i = 0; i < n; ++i)
      s[i] = std::cos(static_cast<double>(i * (lesson + 2)));
    const Pair now = pair(s, VectorX::LinSpaced(n, 1.0, 30.0));
    if (lesson == 0) expected = VectorX::Constant(n, now.y.squaredNorm() * now.rho);
    mass.learn(1, [&](int) -> const Pair& { return now; });
    Eigen::MatrixXd b = expected.asDiagonal();
    b *= now.rho * now.y.dot(now.y.cwiseQuotient(expected));
    b += now.rho * now.y * now.y.transpose() - (b * s) * (b * s).transpose() / s.dot(b * s);
    expected = b.diagonal();
    for (Eigen::Index i = 0; i < n; ++i)
      EXPECT_NEAR(mass.inverse()[i] * expected[i], 1.0, 1e-9) << lesson << " " << i;
  }
}

TEST(DiagonalMass, IsTakenWhereItForetellsPairs) {
  avi::DiagonalMass mass(4);
  const VectorX equal = VectorX::Constant(4, 3.0), different{{1.0, 10.0, 100.0, 1000.0}};
  std::vector<Pair> lesson;
  const auto teach = [&](const VectorX& curvatures) {
    lesson.clear();
    for (int k = 0; k < 4; ++k) {
      VectorX s(4);
      for (Eigen::Index i = 0; i < 4; ++i)
        s[i] = std::sin(1.0 + static_cast<double>(i * k + k + i)) / std::sqrt(curvatures[i]);
      lesson.push_back(pair(s, curvatures));
    }
    return mass.learn(4, [&](int k) -> const Pair& { return lesson[static_cast<std::size_t>(k)]; });
  };
  EXPECT_FALSE(teach(equal));
  teach(different);
  EXPECT_TRUE(teach(different));
  mass.forget();
  EXPECT_FALSE(teach(equal));
}

TEST(DiagonalMass, StaysPositiveAlongAxes) {
  avi::DiagonalMass mass(3);
  for (Eigen::Index axis : {0, 1, 2, 0, 1, 2}) {
    const Pair now = pair(VectorX::Unit(3, axis), VectorX{{1e-8, 1.0, 1e8}});
    mass.learn(1, [&](int) -> const Pair& { return now; });
    for (int i = 0; i < 3; ++i)
      EXPECT_GT(mass.inverse()[i], 0.0);
  }
}

}  // namespace diagonal_mass_test
