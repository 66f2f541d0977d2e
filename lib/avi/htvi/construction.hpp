#pragma once

/// @file
/// The freedom in the construction of an HTVI.

namespace avi {

/// Which generating function a step comes from.
enum class Generating {
  type2,  ///< H_d^+(q_0, p_1), the discrete right Hamiltonian.
  type3   ///< H_d^-(q_1, p_0), the discrete left Hamiltonian.
};

/// What the action of the discrete Hamiltonian is made of. Every choice gives a symplectic map; they differ
/// in order and cost.
enum class Construction {
  /// The velocity in the action is the derivative of the trial curve: order 2r + 2 (StationaryAction).
  stationary,
  /// As the paper prints it (Section 2.2): the velocity is that of the field, the position has order r at the
  /// nodes of the quadrature. Order r + 1 (PrintedAction).
  printed,
  /// What gives the errors printed in Tables 1 and 2: as printed, but the trial curve follows the field with
  /// H + p^t = 0 inserted, and at the node c = 1 the position has order r + 1.
  authors
};

inline constexpr Construction stationary = Construction::stationary;  ///< The default.
inline constexpr Construction printed = Construction::printed;        ///< The paper's text.
inline constexpr Construction authors = Construction::authors;        ///< The paper's tables.

}  // namespace avi
