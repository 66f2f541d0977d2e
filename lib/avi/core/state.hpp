#pragma once
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
    // A loop compiles faster than Eigen's tests; this one is vectorised.
    int finite = std::isfinite(t);
    for (const auto* x : {&q, &p})
      for (Eigen::Index i = 0; i < x->size(); ++i)
        finite &= std::abs((*x)[i]) <= std::numeric_limits<double>::max();
    return finite != 0;
  }
  /// The same numbers.
  [[nodiscard]] bool operator==(const State& other) const {
    return t == other.t && std::equal(q.begin(), q.end(), other.q.begin(), other.q.end()) &&
           std::equal(p.begin(), p.end(), other.p.begin(), other.p.end());
  }
};

/// Refuses a start whose dimension, given at run time, is none.
/// @throws std::invalid_argument unless q and p have the same number of entries, at least 1.
template <int n>
void require_dimension([[maybe_unused]] const State<n>& start) {
  if constexpr (n == dynamic) {
    require(start.q.size() >= 1, "Dimension of q at the start", start.q.size(), "at least 1");
    require(start.p.size() == start.q.size(), "Dimension of p at the start", start.p.size(), "that of q, ",
            start.q.size());
  }
}

}  // namespace avi
