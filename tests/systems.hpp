#pragma once
#include "avi/core/state.hpp"

#include <cmath>

/// @file
/// Hamiltonians of which many tests follow orbits, with numbers of any kind, and where one of them begins.

namespace systems {

inline constexpr auto spring = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0] + q[0] * q[0]); };
inline constexpr auto pendulum = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - cos(q[0]); };
/// A body in the field of a fixed one, in the plane.
inline constexpr auto kepler = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(q[0] * q[0] + q[1] * q[1]);
};
inline constexpr auto kepler_in_space = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) -
         1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
};
/// The same in a frame that turns.
inline auto turning_kepler(double turns) {
  return [=](const auto& q, const auto& p) { return kepler(q, p) - turns * (q[0] * p[1] - q[1] * p[0]); };
}
/// In the frame that turns with a body of mass 1 - mass and with one of this mass, at a distance of 1.
inline auto restricted(double mass) {
  return [=](const auto& q, const auto& p) {
    const auto x = q[0] + mass, y = q[0] - (1.0 - mass);
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + q[1] * p[0] - q[0] * p[1] -
           (1.0 - mass) / sqrt(x * x + q[1] * q[1]) - mass / sqrt(y * y + q[1] * q[1]);
  };
}
/// Of two fixed bodies, one of half the mass of the other.
inline constexpr auto two_centres = [](const auto& q, const auto& p) {
  const auto x = q[0] - 1.0, y = q[0] + 1.0;
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(x * x + q[1] * q[1]) -
         0.5 / sqrt(y * y + q[1] * q[1]);
};
/// A charge in the field of a dipole.
inline constexpr auto dipole = [](const auto& q, const auto& p) {
  const auto b = pow(q[0] * q[0] + q[1] * q[1] + q[2] * q[2], -1.5);
  const auto x = p[0] + b * q[1], y = p[1] - b * q[0];
  return 0.5 * (x * x + y * y + p[2] * p[2]);
};
/// A spring whose body comes near the speed of light, 1.
inline constexpr auto relativistic = [](const auto& q, const auto& p) {
  return sqrt(1.0 + p[0] * p[0]) + 0.5 * q[0] * q[0];
};
/// It falls to a singularity at 0.
inline constexpr auto logarithm = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + log(q[0]); };
/// The lift of q' = 1 + q^2, which comes to infinity.
inline constexpr auto blow_up = [](const auto& q, const auto& p) { return p[0] * (1.0 + q[0] * q[0]); };

/// One degree of freedom.
inline avi::State<1> at(double q, double p, double t = 0.0) { return {.q = {q}, .p = {p}, .t = t}; }

}  // namespace systems
