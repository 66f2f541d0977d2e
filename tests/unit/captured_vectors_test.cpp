#include "avi/avi.hpp"
#include "avi/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

// Vectors and matrices of doubles that H or a monitor holds stand beside q and p, whatever these are made of.

namespace captured_vectors_test {

/// Springs about a point b, through a matrix k.
template <int n>
void compare() {
  using Vec = Eigen::Matrix<double, n, 1>;
  const Vec b = Vec::LinSpaced(-0.3, 0.4);
  const Eigen::Matrix<double, n, n> k = Vec::LinSpaced(1.0, 2.0).asDiagonal().toDenseMatrix();
  const auto hamiltonian = [=](const auto& q, const auto& p) {
    return 0.5 * p.squaredNorm() + 0.5 * (q - b).squaredNorm() + 0.1 * q.dot(b) + 0.5 * q.dot(k * q);
  };
  const auto monitor = [=](const auto& q) { return 1.0 + 0.1 * (q - b).squaredNorm(); };
  avi::State<n> start;
  start.q = Vec::LinSpaced(0.5, 1.0), start.p = Vec::LinSpaced(0.2, -0.4), start.t = 0.0;
  const auto problem = avi::poincare(hamiltonian, start, monitor);
  const auto truth = avi::solve(hamiltonian, start, 1.0, 1e-12).state;
  const auto off = [&](auto method, double h) {
    avi::State<n> z = start;
    EXPECT_TRUE(avi::integrate_to(method, z, h, 1.0).ok());
    return std::max((z.q - truth.q).cwiseAbs().maxCoeff(), (z.p - truth.p).cwiseAbs().maxCoeff());
  };
  EXPECT_LT(off(avi::collocation(problem, 8), 0.05), 3e-13) << n;  // measured at most 1.2e-13
  if constexpr (n == 2) {
    EXPECT_LT(off(avi::htvi<4>(problem), 0.01), 6e-8) << n;  // measured at most 2.7e-8
  }
}

TEST(CapturedVectors, StandBesideThoseOfAnyScalar) {
  compare<2>();
  compare<9>();
}

}  // namespace captured_vectors_test
