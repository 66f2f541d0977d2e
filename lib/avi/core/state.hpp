#pragma once
#include "avi/core/vector.hpp"

#include <cmath>

/// @file
/// The point in phase space that every integrator moves.

namespace avi {

/// Position q, momentum p (n entries each) and physical time t. The library uses the sign convention
/// \f$\dot q = \partial H/\partial p\f$, \f$\dot p = -\partial H/\partial q\f$; units are the problem's own.
template <int n>
struct State {
  static constexpr int dimension = n;  ///< n, or avi::dynamic.
  Vector<double, n> q;                 ///< Position.
  Vector<double, n> p;                 ///< Momentum, conjugate to q.
  double t = 0.0;                      ///< Physical time.

  /// True when every entry of q, p and t is finite.
  [[nodiscard]] bool finite() const {
    // If an entry is infinite or NaN, so is the sum: usually one test is enough.
    return std::isfinite(q.sum() + p.sum() + t) || (q.allFinite() && p.allFinite() && std::isfinite(t));
  }
};

}  // namespace avi
