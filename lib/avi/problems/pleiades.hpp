#pragma once
#include "avi/problems/n_body.hpp"

/// @file
/// Seven stars in the plane that nearly collide.

namespace avi {

/// Seven stars of masses 1, 2, ... 7 in the plane, dimension 14, with several close encounters until t = 3,
/// the nearest at a distance of 0.034 (Hairer, Norsett and Wanner, Solving Ordinary Differential
/// Equations I, 1993, Section II.10).
struct Pleiades {
  static constexpr double horizon = 3.0;  ///< End of the time interval of the source.

  /// The problem; `bodies` is 7 or avi::dynamic.
  template <int bodies = 7>
  static NBody<bodies> problem() {
    static_assert(bodies == 7 || bodies == dynamic, "The cluster has seven stars.");
    typename NBody<bodies>::Masses masses(7);
    masses << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0;
    return NBody<bodies>(masses);
  }

  /// Four of the stars are at rest.
  template <int n = 14>
  static State<n> start() {
    State<n> z{.q = Vector<double, n>(14), .p = Vector<double, n>::Zero(14)};
    z.q << 3.0, 3.0, 3.0, -3.0, -1.0, 2.0, -3.0, 0.0, 2.0, 0.0, -2.0, -4.0, 2.0, 4.0;
    z.p[7] = 4.0 * -1.25;
    z.p[9] = 5.0 * 1.0;
    z.p[10] = 6.0 * 1.75;
    z.p[12] = 7.0 * -1.5;
    return z;
  }
};

}  // namespace avi
