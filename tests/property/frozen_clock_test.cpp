#include "avi/bregman/bregman_htvi.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "common/problems/correlated_quartic.hpp"

#include <gtest/gtest.h>

// The theory of docs/optimisation.md.

using avi::VectorX;
using Matrix = Eigen::MatrixXd;

namespace frozen_clock_test {

constexpr Eigen::Index n = 4;

/// z = (q, d) -> (q + alpha d, beta d - grad f(q + alpha d)).
VectorX heavy_ball(const VectorX& z, double alpha, double beta) {
  const experiment::CorrelatedQuartic f(n);
  VectorX q = z.head(n) + alpha * z.tail(n), g(n), out(2 * n);
  f(q, g);
  out << q, beta * z.tail(n) - g;
  return out;
}

/// |J^T Omega J - beta Omega| of a map, J by differences.
template <class Map>
double conformal_defect(const Map& map, const VectorX& z, double beta) {
  const Matrix j = avi::difference_jacobian(map, z);
  Matrix omega = Matrix::Zero(2 * n, 2 * n);
  omega.topRightCorner(n, n).setIdentity();
  omega.bottomLeftCorner(n, n) = -Matrix::Identity(n, n);
  return (j.transpose() * omega * j - beta * omega).norm();
}

TEST(FrozenClock, IsConformallySymplecticWithFactorBeta) {
  VectorX z(2 * n);
  z << 1.5, 0.7, 1.2, 0.4, 0.3, -0.2, 0.1, 0.4;
  for (double beta : {0.0, 0.3, 0.9, 1.0}) {
    const auto frozen = [&](const VectorX& at) { return heavy_ball(at, 0.1, beta); };
    EXPECT_LT(conformal_defect(frozen, z, beta), 2e-14) << beta;  // measured 9.3e-15 and less
  }
  // Not frozen: alpha follows the state within the step.
  const auto loose = [&](const VectorX& at) {
    return heavy_ball(at, 0.1 / (1.0 + at.head(n).squaredNorm()), 0.9);
  };
  EXPECT_GT(conformal_defect(loose, z, 0.9), 1e-3);
}

TEST(FrozenClock, ConjugateGradientsRunOnAClockLikeTheInverseSquaredGradient) {
  // Linear conjugate gradients with Fletcher and Reeves' factor, against r+ = r - t+^P grad f(q+), q+ = q +
  // alpha t^-P r with t^P = |g_0|^2 / |g|^2: the Bregman form, whose map (q, r) is symplectic. The same
  // iterates.
  const Eigen::Index m = 12;
  VectorX c(m);
  for (Eigen::Index i = 0; i < m; ++i)
    c[i] = 1.0 + static_cast<double>(i);
  VectorX x = VectorX::Ones(m), q = x, g = c.cwiseProduct(x), d = -g, r = -g;
  const double first = g.squaredNorm();
  double power = 1.0;  // t^P
  for (int k = 0; k < 12; ++k) {
    const double alpha = g.squaredNorm() / d.dot(c.cwiseProduct(d));
    x += alpha * d;
    const VectorX next = g + alpha * c.cwiseProduct(d);
    d = (next.squaredNorm() / g.squaredNorm()) * d - next;
    g = next;
    q += (alpha / power) * r;
    const VectorX force = c.cwiseProduct(q);
    power = first / force.squaredNorm();
    r -= power * force;
    EXPECT_LT((q - x).norm(), 1e-9) << k;
  }
  EXPECT_LT(g.norm(), 1e-8 * std::sqrt(first));  // twelve eigenvalues, twelve steps
}

TEST(ExponentialFamily, IsTheLimitOfLargeOrder) {
  // Order P with the fictive step eta / P from t = 1: momentum (t/t+)^P -> e^-eta, the constant friction of
  // the exponential family e^{-2 s} kinetic, e^{2 s} potential in s = P log t.
  const double eta = 0.3;
  double last = 1.0;
  for (double P : {1e1, 1e3, 1e5}) {
    const avi::BregmanHeavyBall ball{.family = avi::BregmanFamily::direct(P), .h = eta / P};
    const double momentum = std::exp(-P * ball.advance(0.0)), gap = std::abs(momentum - std::exp(-eta));
    EXPECT_LT(gap, 0.1 * last);
    EXPECT_LT(gap, 1.0 / P);
    EXPECT_NEAR(ball.step(0.0), eta * eta * ball.family.C, 1e-12);  // and the step does not depend on P
    last = gap;
  }
}

TEST(HeavyBall, OrderTwoHasNesterovsFriction) {
  // x'' + (p + 1)/t x' + C p^2 t^(p-2) grad f = 0: the displacement of a free flight shrinks by (t/t+)^(p+1),
  // Direct.
  for (double p : {2.0, 4.0}) {
    const avi::BregmanHeavyBall ball{.family = avi::BregmanFamily::direct(p), .h = 1e-4};
    const double t = 5.0, ahead = ball.advance(std::log(t));
    const double damping = std::exp(-(p + ball.family.s()) * ahead);
    EXPECT_NEAR((1.0 - damping) / 1e-4, (p + 1.0) / t, 1e-3) << "friction, p = " << p;
  }
}

}  // namespace frozen_clock_test
