#pragma once
#include "avi/adaptive/poincare.hpp"

/// @file
/// The freedom in the construction of an HTVI.

namespace avi {

/// To which order the position at the quadrature nodes is expanded; the momentum always has order r.
enum class NodePosition {
  r,           ///< Order r at every node, as the construction is printed (Section 2.2 of the paper).
  end_raised,  ///< Order r + 1 at the node c = 1, where q~_1 is at hand, and r elsewhere.
  raised       ///< Order r + 1 at every node.
};

/// The freedom that the text of the paper leaves in an HTVI of given order and quadrature.
struct Construction {
  Field field;                                           ///< What is expanded.
  NodePosition nodes;                                    ///< Position at the quadrature nodes.
  bool operator==(const Construction&) const = default;  ///< Equal in both.
};

/// The construction as printed.
inline constexpr Construction printed{Field::full, NodePosition::r};
/// The construction that gives the errors printed in Tables 1 and 2.
inline constexpr Construction authors{Field::on_shell, NodePosition::end_raised};
/// Order r + 1 for the position at all nodes. Without monitor, for H = T(p) + V(q), q' = dH/dp then holds
/// exactly along the trial curve, the action is stationary on it, and the order becomes min(2 (r + 1), s)
/// (measured by the experiment order_verification); a monitor breaks that identity and the order is the
/// theorem's.
inline constexpr Construction superconvergent{Field::on_shell, NodePosition::raised};

}  // namespace avi
