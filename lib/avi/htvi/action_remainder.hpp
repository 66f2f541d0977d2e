#pragma once

/// @file
/// The variation of an action without its boundary terms.

namespace avi {

/// The remainder R in \f$\delta A = [p\cdot\delta q]_0^h + R\f$ of a discrete action A on the trial curve of
/// one step. R vanishes for every variation exactly where the curve makes the action stationary, which is
/// Hamilton's principle; the right-hand side of the discrete Hamilton's equations consists of R alone
/// (DiscreteEquations).
/// @tparam Lane a number with partials along the variations of the curve: of its initial values, and of p^t
template <class Lane>
struct ActionRemainder {
  Lane variation;  ///< R: its partials (its value means nothing).
  double time;     ///< dA/dp^t at a fixed curve, less what is in R: t_1 - t_0 in the absence of R.
};

}  // namespace avi
