#pragma once
#include "avi/core/fixed_order.hpp"
#include "avi/core/require.hpp"

#include <cmath>
#include <complex>
#include <utility>

/// @file
/// The general Bregman family of Wibisono, Wilson and Jordan (2016): scalings alpha, beta, gamma.

namespace avi {

/// Three functions of time, each a callable generic in its scalar type (double and std::complex<double>).
template <class Alpha, class Beta, class Gamma>
struct BregmanScaling {
  Alpha alpha;  ///< Logarithm of the rate.
  Beta beta;    ///< Logarithm of the weight of the objective; f falls like e^-beta (equation (4.7)).
  Gamma gamma;  ///< Logarithm of the damping factor.
};

/// Deduces the types of the three callables.
template <class Alpha, class Beta, class Gamma>
BregmanScaling<Alpha, Beta, Gamma> bregman_scaling(Alpha alpha, Beta beta, Gamma gamma) {
  return {std::move(alpha), std::move(beta), std::move(gamma)};
}

/// Derivative of a callable that is analytic, by the complex step Im f(t + i d) / d with d = 1e-30: no
/// subtraction, so exact to round-off (Squire and Trapp 1998).
template <class Function>
double derivative(const Function& f, double t) {
  constexpr double d = 1e-30;
  return f(std::complex<double>(t, d)).imag() / d;
}

/// By how much the ideal scaling conditions of equation (4.6), \f$\dot\beta \le e^\alpha\f$ and
/// \f$\dot\gamma = e^\alpha\f$, are missed at time t, relative to \f$e^\alpha\f$; both entries are 0 up to
/// round-off when they hold.
struct ScalingDefect {
  double beta;   ///< max(0, beta' e^-alpha - 1).
  double gamma;  ///< |gamma' e^-alpha - 1|.
};

/// The defect of a scaling at time t.
template <class A, class B, class G>
ScalingDefect ideal_scaling_defect(const BregmanScaling<A, B, G>& scaling, double t) {
  const double rate = std::exp(scaling.alpha(t));
  return {.beta = std::max(0.0, derivative(scaling.beta, t) / rate - 1.0),
          .gamma = std::abs(derivative(scaling.gamma, t) / rate - 1.0)};
}

/// Checks a scaling. @throws std::invalid_argument unless the ideal scaling conditions hold at t to the
/// relative tolerance.
template <class A, class B, class G>
void require_ideal_scaling(const BregmanScaling<A, B, G>& scaling, double t, double tolerance = 1e-12) {
  const auto [beta, gamma] = ideal_scaling_defect(scaling, t);
  require(beta <= tolerance, "Excess of beta' over e^alpha", beta, "0: the ideal scaling conditions");
  require(gamma <= tolerance, "Defect of gamma' = e^alpha", gamma, "0: the ideal scaling conditions");
}

/// The polynomial scaling of order p, equation (4.10): \f$\alpha = \log p - \log t\f$,
/// \f$\beta = p \log t + \log C\f$, \f$\gamma = p \log t\f$. @throws std::invalid_argument unless p > 0 and C
/// > 0.
inline auto polynomial_scaling(double p, double C) {
  require_positive("Order p", p);
  require_positive("Weight C", C);
  return bregman_scaling(
      [p](auto t) {
        using std::log;
        return std::log(p) - log(t);
      },
      [p, C](auto t) {
        using std::log;
        return p * log(t) + std::log(C);
      },
      [p](auto t) {
        using std::log;
        return p * log(t);
      });
}

/// The scaling after the time change \f$y(t) = x(\tau(t))\f$, equation (4.8):
/// \f$\alpha(\tau) + \log\dot\tau\f$, \f$\beta(\tau)\f$, \f$\gamma(\tau)\f$. `tau` and `tau_rate` are generic
/// callables.
template <class A, class B, class G, class Tau, class Rate>
auto dilate(const BregmanScaling<A, B, G>& scaling, Tau tau, Rate tau_rate) {
  return bregman_scaling(
      [a = scaling.alpha, tau, tau_rate](auto t) {
        using std::log;
        return a(tau(t)) + log(tau_rate(t));
      },
      [b = scaling.beta, tau](auto t) { return b(tau(t)); },
      [g = scaling.gamma, tau](auto t) { return g(tau(t)); });
}

/// The Bregman Hamiltonian (equation (4.5)) of the Euclidean norm, \f$h(x) = \tfrac12 |x|^2\f$, where the
/// divergence of \f$h^*\f$ is \f$\tfrac12 |e^{-\gamma} r|^2\f$. \f[ H(x, r, t) = e^{\alpha + \gamma}
/// \left[ \tfrac12 e^{-2\gamma} |r|^2 + e^\beta f(x) \right], \f] `value` = f(x). (The paper's display for
/// the polynomial family, (4.12), has \f$t^p r\f$ inside the divergence; \f$e^{-\gamma} r = t^{-p} r\f$ is
/// meant, and (4.14) agrees with that.)
template <class A, class B, class G>
double bregman_hamiltonian(const BregmanScaling<A, B, G>& scaling, double value, const VectorX& r, double t) {
  const double gamma = scaling.gamma(t);
  return std::exp(scaling.alpha(t) + gamma) *
         (0.5 * std::exp(-2.0 * gamma) * dot(r, r) + std::exp(scaling.beta(t)) * value);
}

}  // namespace avi
