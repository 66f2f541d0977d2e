#include "avi/bregman/bregman_family.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

// Section 4.2 of the paper: the general Bregman family of Wibisono, Wilson and Jordan (2016), of which the
// library integrates the polynomial one.

namespace ideal_scaling_test {

/// Scalings alpha, beta, gamma as functions of time, for double and std::complex<double>.
template <class Alpha, class Beta, class Gamma>
struct Scaling {
  Alpha alpha;
  Beta beta;
  Gamma gamma;
};
// clang++ 14 deduces no arguments of an aggregate by itself.
template <class Alpha, class Beta, class Gamma>
Scaling(Alpha, Beta, Gamma) -> Scaling<Alpha, Beta, Gamma>;

/// Derivative by the complex step: no subtraction, so exact to round-off (Squire and Trapp 1998).
template <class Function>
double derivative(const Function& f, double t) {
  return f(std::complex<double>(t, 1e-30)).imag() / 1e-30;
}

/// Equation (4.10): alpha = log p - log t, beta = p log t + log C, gamma = p log t.
auto polynomial(double p, double C) {
  return Scaling{[=](auto t) { return std::log(p) - std::log(t); },
                 [=](auto t) { return p * std::log(t) + std::log(C); },
                 [=](auto t) { return p * std::log(t); }};
}

/// Equation (4.6), beta' <= e^alpha and gamma' = e^alpha, relative to e^alpha.
template <class S>
void expect_ideal(const S& scaling, double t) {
  const double rate = std::exp(scaling.alpha(t));
  EXPECT_LE(derivative(scaling.beta, t) / rate, 1.0 + 1e-14) << "t = " << t;
  EXPECT_NEAR(derivative(scaling.gamma, t) / rate, 1.0, 1e-14) << "t = " << t;
}

TEST(IdealScaling, HoldsForThePolynomialFamilyWhoseHamiltonianIsTheDirectOne) {
  const double p = 3.0, C = 0.4, value = 1.7, square = 5.09;  // f(x), |r|^2
  const auto scaling = polynomial(p, C);
  const auto family = avi::BregmanFamily::direct(p, C);
  for (double t : {0.3, 1.0, 7.0}) {
    expect_ideal(scaling, t);
    // Equation (4.5) with the Euclidean norm: e^(alpha + gamma) (e^(-2 gamma) |r|^2 / 2 + e^beta f). The
    // paper's (4.12) has t^p r inside the divergence; t^(-p) r is meant, and (4.14) agrees with that.
    const double gamma = scaling.gamma(t);
    const double hamiltonian = std::exp(scaling.alpha(t) + gamma) *
                               (0.5 * std::exp(-2.0 * gamma) * square + std::exp(scaling.beta(t)) * value);
    EXPECT_NEAR(hamiltonian / (0.5 * family.kinetic(t) * square + family.potential(t) * value), 1.0, 1e-13);
  }
}

TEST(IdealScaling, TimeDilationMovesWithinTheFamily) {
  // y(t) = x(t^k) of the order p system obeys the order k p system: equation (4.8), theorem TimeDilation.
  const double p = 4.0, k = 0.25, C = 0.4;
  const auto fast = polynomial(p, C), expected = polynomial(k * p, C);
  const auto tau = [=](auto t) { return std::pow(t, k); };
  const Scaling slow{[=](auto t) { return fast.alpha(tau(t)) + std::log(k * std::pow(t, k - 1.0)); },
                     [=](auto t) { return fast.beta(tau(t)); }, [=](auto t) { return fast.gamma(tau(t)); }};
  for (double t : {0.4, 1.0, 5.0}) {
    EXPECT_NEAR(slow.alpha(t), expected.alpha(t), 1e-14);
    EXPECT_NEAR(slow.beta(t), expected.beta(t), 1e-14);
    EXPECT_NEAR(slow.gamma(t), expected.gamma(t), 1e-14);
    expect_ideal(slow, t);
  }
}

TEST(IdealScaling, TheTransformToTheLowerOrderIsDirectWithThatOrder) {
  // The paper's text speaks of a transform from order p to the lower order p_ring. Time dilation gives it: t
  // = tau^(p_ring/p), monitor dt/dtau = (p_ring/p) t^(1 - p/p_ring). In tau its coefficients are those of
  // Direct with p_ring, while Adaptive (p, p_ring) is of order p^2 / p_ring.
  for (const auto& [p, p_ring] : {std::pair{4.0, 2.0}, {4.0, 1.0}, {10.0, 0.5}}) {
    const auto high = avi::BregmanFamily::direct(p, 0.4), low = avi::BregmanFamily::direct(p_ring, 0.4);
    for (double tau : {0.7, 1.0, 30.0}) {
      const double t = std::pow(tau, p_ring / p), monitor = (p_ring / p) * std::pow(t, 1.0 - p / p_ring);
      EXPECT_NEAR(monitor * high.kinetic(t) / low.kinetic(tau), 1.0, 1e-12);
      EXPECT_NEAR(monitor * high.potential(t) / low.potential(tau), 1.0, 1e-12);
      EXPECT_NEAR(monitor, (p_ring / p) * std::pow(tau, p_ring / p - 1.0), 1e-12 * monitor);  // dt/dtau
    }
    EXPECT_EQ(avi::BregmanFamily::adaptive(p, p_ring).order(), p * p / p_ring);
  }
}

}  // namespace ideal_scaling_test
