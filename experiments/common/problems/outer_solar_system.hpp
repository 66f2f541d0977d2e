#pragma once
#include "avi/problems/n_body.hpp"

// The Sun and the five outer planets.

namespace experiment {

using avi::State, avi::NBody;

/// The Sun (with the inner planets), Jupiter, Saturn, Uranus, Neptune and Pluto as point masses: dimension
/// 18. Data for 5 September 1994, 0h (Hairer, Lubich and Wanner, Geometric Numerical Integration, 2006,
/// Section I.2.4; after Applegate, Douglas, Gursel, Sussman and Wisdom 1986). Lengths are in astronomical
/// units, time in days; masses are multiplied by the gravitational constant G, so that H is G times the
/// energy.
struct OuterSolarSystem {
  static constexpr double gravity = 2.95912208286e-4;  ///< G, with the mass of the Sun as the unit.

  /// The six-body problem.
  static NBody<6, 3> problem() {
    NBody<6, 3>::Masses masses;
    masses << 1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546, 0.0000517759138449,
        1.0 / 1.3e8;
    return NBody<6, 3>(gravity * masses);
  }

  /// Positions and momenta on that date.
  static State<18> start() {
    State<18> z;
    z.q << 0.0, 0.0, 0.0,                      //
        -3.5023653, -3.8169847, -1.5507963,    //
        9.0755314, -3.0458353, -1.6483708,     //
        8.3101420, -16.2901086, -7.2521278,    //
        11.4707666, -25.7294829, -10.8169456,  //
        -15.5387357, -25.2225594, -3.1902382;
    z.p << 0.0, 0.0, 0.0,                      //
        0.00565429, -0.00412490, -0.00190589,  //
        0.00168318, 0.00483525, 0.00192462,    //
        0.00354178, 0.00137102, 0.00055029,    //
        0.00288930, 0.00114527, 0.00039677,    //
        0.00276725, -0.00170702, -0.00136504;
    const auto masses = problem().masses();
    for (int i = 0; i < 18; ++i)
      z.p[i] *= masses[i / 3];
    return z;
  }
};

}  // namespace experiment
