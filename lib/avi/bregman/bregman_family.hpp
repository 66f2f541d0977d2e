#pragma once
#include "avi/core/require.hpp"

#include <cmath>

/// @file
/// BregmanFamily: the polynomial family of Bregman Hamiltonians, with or without adapted time.

namespace avi {

/// The Poincare-transformed Bregman Hamiltonian of the paper's equation (4.18).
/// \f{gather*}{
/// \bar H(q, t, r, r^t) = \tfrac12\, kinetic(t)\, |r|^2 + potential(t)\, f(q) + monitor(t)\, r^t,
/// \\ kinetic(t) = P\, t^{-p-s}, \quad potential(t) = C P\, t^{2p-s}, \quad
/// monitor(t) = (p/\mathring p)\, t^{1-s}
/// \f} with \f$P = p^2/\mathring p\f$ and \f$s = \mathring p/p\f$. The Direct approach, equation (4.16), is
/// the case \f$\mathring p = p\f$, in which P = p, s = 1 and the monitor is 1. So the same formulas serve
/// both approaches.
///
/// In the fictive time \f$\tau = t^s\f$ the coefficients are \f$P \tau^{-P-1}\f$ and \f$C P \tau^{2P-1}\f$.
/// The adapted system is therefore the Bregman system of the *higher* order \f$P = p^2/\mathring p\f$, not of
/// the lower order \f$\mathring p\f$ that the text of the paper names. Its monitor is the inverse of the one
/// required for the time dilation \f$\tau = t^s\f$.
struct BregmanFamily {
  double p = 2.0;       ///< Order of the Bregman dynamics, positive.
  double p_ring = 2.0;  ///< Parameter of the monitor, in (0, p].
  double C = 0.0625;    ///< Weight of the objective, positive; 1/16 in the paper's tables (not stated there).

  /// The family of the Direct approach. @throws std::invalid_argument for p or C out of range.
  static BregmanFamily direct(double p, double C = 0.0625) { return adaptive(p, p, C); }

  /// The family of the Adaptive approach. @throws std::invalid_argument for a parameter out of range.
  static BregmanFamily adaptive(double p, double p_ring, double C = 0.0625) {
    const BregmanFamily family{.p = p, .p_ring = p_ring, .C = C};
    family.validate();
    return family;
  }

  /// Checks the ranges. @throws std::invalid_argument for a parameter out of range.
  void validate() const {
    require_positive("Order p", p);
    require(p_ring > 0.0 && p_ring <= p, "Parameter p_ring", p_ring, "positive and at most p");
    require_positive("Weight C", C);
    require_positive("Order p^2 / p_ring in fictive time", order());
  }

  [[nodiscard]] bool is_direct() const { return p_ring == p; }   ///< True without adaptivity.
  [[nodiscard]] double order() const { return p * p / p_ring; }  ///< P, the order in fictive time.
  [[nodiscard]] double s() const { return p_ring / p; }          ///< Exponent in tau = t^s.

  /// @name Coefficients at physical time t > 0
  /// @{

  /// Coefficient of |r|^2 / 2 at time t.
  [[nodiscard]] double kinetic(double t) const { return order() * std::pow(t, -p - s()); }
  /// Coefficient of f(q) at time t.
  [[nodiscard]] double potential(double t) const { return C * order() * std::pow(t, 2.0 * p - s()); }
  /// Coefficient of r^t at time t: dt/dtau (equation (4.17)).
  [[nodiscard]] double monitor(double t) const { return std::pow(t, 1.0 - s()) / s(); }
  /// @}

  /// @name Derivatives with respect to t
  /// @{

  /// Derivatives by t of kinetic(), potential() and monitor().
  [[nodiscard]] double kinetic_rate(double t) const { return -(p + s()) * kinetic(t) / t; }
  [[nodiscard]] double potential_rate(double t) const { return (2.0 * p - s()) * potential(t) / t; }
  [[nodiscard]] double monitor_rate(double t) const { return (1.0 - s()) * monitor(t) / t; }
  /// @}

  /// Physical time after a fictive step h from time t, exactly: t^s advances by h.
  [[nodiscard]] double exact_clock(double t, double h) const {
    return is_direct() ? t + h : std::pow(std::pow(t, s()) + h, 1.0 / s());
  }
};

/// The start of the paper's runs: t_0 = 1, and every entry of the momentum 1. The paper does not state it; it
/// was recovered from the iteration counts there, which no other start gives.
struct BregmanStart {
  double t = 1.0;         ///< Start time, positive.
  double momentum = 1.0;  ///< Every entry of the initial momentum, finite.

  /// Checks the ranges. @throws std::invalid_argument for a value out of range.
  void validate() const {
    require_positive("Start time t0", t);
    require_finite("Start momentum r0", momentum);
  }
};

/// Checks the parameters of any method with a fixed fictive step h. @throws std::invalid_argument for a value
/// out of range.
inline void validate(const BregmanFamily& family, const BregmanStart& from, double h) {
  family.validate();
  from.validate();
  require_positive("Step size h", h);
}

}  // namespace avi
