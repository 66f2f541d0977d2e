#pragma once
#include "avi/core/require.hpp"

#include <cmath>

/// @file
/// The polynomial family of Bregman Hamiltonians, integrated as it is or with adapted time.

namespace avi {

/// The Poincare-transformed Bregman Hamiltonian of the paper's equation (4.18).
/// \f{gather*}{
/// \bar H(q, t, r, r^t) = \tfrac12\, kinetic(t)\, |r|^2 + potential(t)\, f(q) + monitor(t)\, r^t,
/// \\ kinetic(t) = P\, t^{-p-s}, \quad potential(t) = C P\, t^{2p-s}, \quad
/// monitor(t) = (p/\mathring p)\, t^{1-s}
/// \f} with \f$P = p^2/\mathring p\f$ and \f$s = \mathring p/p\f$. The Direct approach, equation (4.16), is
/// the case \f$\mathring p = p\f$: then P = p, s = 1 and the monitor is 1. So one set of formulas serves
/// both.
///
/// In the fictive time \f$\tau = t^s\f$ the coefficients are \f$P \tau^{-P-1}\f$ and \f$C P \tau^{2P-1}\f$:
/// the adapted system is the Bregman system of the *higher* order \f$P = p^2/\mathring p\f$, not of the lower
/// order \f$\mathring p\f$ that the paper's text names; its monitor is the inverse of the one that time
/// dilation by \f$\tau = t^s\f$ asks for.
struct BregmanFamily {
  double p = 2.0;       ///< Order of the Bregman dynamics, positive.
  double p_ring = 2.0;  ///< Parameter of the monitor, in (0, p].
  double C = 0.0625;  ///< Weight of the objective, positive. The paper's tables have 1/16 (not stated there).

  /// The Direct approach. @throws std::invalid_argument for p or C out of range.
  static BregmanFamily direct(double p, double C = 0.0625) { return adaptive(p, p, C); }

  /// The Adaptive approach. @throws std::invalid_argument for a parameter out of range.
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

  [[nodiscard]] bool is_direct() const { return p_ring == p; }   ///< Without adaptivity.
  [[nodiscard]] double order() const { return p * p / p_ring; }  ///< P, the order in fictive time.
  [[nodiscard]] double s() const { return p_ring / p; }          ///< tau = t^s.

  /// @name Coefficients at physical time t > 0
  /// @{

  /// Coefficient of |r|^2 / 2.
  [[nodiscard]] double kinetic(double t) const { return order() * std::pow(t, -p - s()); }
  /// Coefficient of f(q).
  [[nodiscard]] double potential(double t) const { return C * order() * std::pow(t, 2.0 * p - s()); }
  /// Coefficient of r^t: dt/dtau (equation (4.17)).
  [[nodiscard]] double monitor(double t) const { return std::pow(t, 1.0 - s()) / s(); }
  /// @}

  /// @name Derivatives with respect to t
  /// @{

  /// Derivative of the coefficient of that name by t.
  [[nodiscard]] double kinetic_rate(double t) const { return -(p + s()) * kinetic(t) / t; }
  [[nodiscard]] double potential_rate(double t) const { return (2.0 * p - s()) * potential(t) / t; }
  [[nodiscard]] double monitor_rate(double t) const { return (1.0 - s()) * monitor(t) / t; }
  /// @}

  /// Physical time after fictive time h, exactly: t^s advances by h.
  [[nodiscard]] double exact_clock(double t, double h) const {
    return is_direct() ? t + h : std::pow(std::pow(t, s()) + h, 1.0 / s());
  }
};

/// Where the runs of the paper start: t_0 = 1 and every entry of the momentum 1. Not stated there; recovered
/// from its iteration counts, which no other start gives.
struct BregmanStart {
  double t = 1.0;         ///< Positive.
  double momentum = 1.0;  ///< Momentum of every entry, finite.

  /// Checks the ranges. @throws std::invalid_argument for a value out of range.
  void validate() const {
    require_positive("Start time t0", t);
    require_finite("Start momentum r0", momentum);
  }
};

/// Checks what all methods with a fixed fictive step h have. @throws std::invalid_argument for a value out of
/// range.
inline void validate(const BregmanFamily& family, const BregmanStart& from, double h) {
  family.validate();
  from.validate();
  require_positive("Step size h", h);
}

}  // namespace avi
