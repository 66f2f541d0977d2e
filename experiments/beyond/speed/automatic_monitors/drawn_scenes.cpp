#include "beyond/speed/automatic_monitors/scenes.hpp"

// Twelve that were held out by the rule of held_out_scenes.cpp for an earlier menu, and looked at since.

namespace experiment {

namespace {

/// Hill's lunar problem (Szebehely 1967): a moon of eccentricity 0.6, which leaves its planet after a turn.
Scene hill() {
  return scene(
      "hill", false,
      [](const V& q, const V& p) {
        return kinetic(p) + q[1] * p[0] - q[0] * p[1] - 1.0 / sqrt(radius_squared(q)) - square(q[0]) +
               0.5 * square(q[1]);
      },
      {0.1, 0.0}, {0.0, 4.1}, 10.0, {radius}, powers_of_length);
}

/// A star on a box orbit of the logarithmic potential (Binney and Tremaine 2008, Section 3.3).
Scene log_galaxy() {
  const auto inner = [](const V& q) { return 0.14 * 0.14 + square(q[0]) + square(q[1]) * (1.0 / 0.81); };
  return scene(
      "log_galaxy", false, [=](const V& q, const V& p) { return kinetic(p) + 0.5 * log(inner(q)); },
      {0.5, 0.0}, {0.7, 0.4}, 30.0, {{"core", [=](const V& q, const V&) { return sqrt(inner(q)); }}},
      powers_of_length);
}

/// A nearly radial orbit of Henon's isochrone.
Scene isochrone() {
  return scene(
      "isochrone", false,
      [](const V& q, const V& p) { return kinetic(p) - 1.0 / (1.0 + sqrt(1.0 + radius_squared(q))); },
      {3.0, 0.0}, {0.0, 0.1}, 100.0,
      {{"core", [](const V& q, const V&) { return sqrt(1.0 + radius_squared(q)); }}}, powers_of_length);
}

/// Kepler's problem, e = 0.9, in polar coordinates.
Scene kepler_polar() {
  return scene(
      "kepler_polar", false,
      [](const V& q, const V& p) {
        return 0.5 * square(p[0]) + 0.5 * square(p[1]) / square(q[0]) - 1.0 / q[0];
      },
      {0.1, 0.0}, {0.0, std::sqrt(0.19)}, 20.0 * M_PI, {{"r", [](const V& q, const V&) { return q[0]; }}},
      powers_of_length);
}

/// The radius of a free fall around a black hole of mass 1 (Misner, Thorne and Wheeler 1973, Chapter 25), in
/// proper time: angular momentum 4, from rest in radius at 30.
Scene schwarzschild() {
  const double energy_squared = (1.0 - 2.0 / 30.0) * (1.0 + 16.0 / 900.0);
  const auto redshift = [](const V& q) { return 1.0 - 2.0 / q[0]; };
  return scene(
      "schwarzschild", false,
      [=](const V& q, const V& p) {
        return 0.5 * (redshift(q) * square(p[0]) - energy_squared / redshift(q) + 16.0 / square(q[0]));
      },
      {30.0}, {0.0}, 3000.0,
      {{"r", [](const V& q, const V&) { return q[0]; }},
       {"outside", [](const V& q, const V&) { return q[0] - 2.0; }}},
      powers_of_length);
}

/// Three ions on the axis of a trap.
Scene trapped_ions() {
  const auto sum = [](const V& q, double k) {
    return pow(q[1] - q[0], -k) + pow(q[2] - q[1], -k) + pow(q[2] - q[0], -k);
  };
  return scene(
      "trapped_ions", false,
      [=](const V& q, const V& p) {
        return kinetic(p) + 0.5 * (radius_squared(q) + square(q[2])) + sum(q, 1.0);
      },
      {-1.5, 0.2, 1.2}, {0.0, 0.0, 0.0}, 60.0,
      {{"gaps1", [=](const V& q, const V&) { return 1.0 / sum(q, 1.0); }},
       {"gaps3", [=](const V& q, const V&) { return pow(sum(q, 3.0), -1.0 / 3.0); }}},
      powers_of_length);
}

/// Poschl and Teller's well.
Scene poschl_teller() {
  return scene("poschl_teller", false,
               [](const V& q, const V& p) { return kinetic(p) - 10.0 * pow(cosh(q[0]), -2.0); }, {2.5}, {0.0},
               50.0, {{"cosh", [](const V& q, const V&) { return cosh(q[0]); }}}, {0.5, 1.0, 2.0});
}

/// A ball that falls on a floor with an exponential repulsion.
Scene bouncing_ball() {
  return scene("bouncing_ball", false,
               [](const V& q, const V& p) { return kinetic(p) + q[0] + exp(-30.0 * q[0]); }, {1.0}, {0.0},
               40.0, {{"hardness", [](const V& q, const V&) { return 1.0 / (1.0 + exp(-30.0 * q[0])); }}},
               {0.25, 0.5, 1.0});
}

/// A spherical pendulum in its angles, which passes close to its lowest point, a pole of the coordinates.
Scene spherical_pendulum() {
  return scene(
      "spherical_pendulum", false,
      [](const V& q, const V& p) { return 0.5 * square(p[0]) + 0.5 * square(p[1] / sin(q[0])) - cos(q[0]); },
      {2.0, 0.0}, {0.0, 0.1}, 40.0, {{"sine", [](const V& q, const V&) { return sin(q[0]); }}},
      powers_of_length);
}

/// Four pendulums in a row with springs, one of them lifted nearly to the top.
Scene coupled_pendulums() {
  return scene(
      "coupled_pendulums", false,
      [](const V& q, const V& p) {
        Recorded sum = kinetic(p);
        for (Eigen::Index i = 0; i < q.size(); ++i) {
          sum -= cos(q[i]);
          if (i > 0) sum += 0.25 * square(q[i] - q[i - 1]);
        }
        return sum;
      },
      {3.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 50.0);
}

/// The two bonds of a bent molecule (Child and Lawton 1981).
Scene local_modes() {
  return scene("local_modes", false,
               [](const V& q, const V& p) {
                 return kinetic(p) - 0.1 * (p[0] * p[1]) + square(1.0 - exp(-q[0])) +
                        square(1.0 - exp(-q[1]));
               },
               {1.5, 0.0}, {0.0, 0.0}, 60.0,
               {{"bonds", [](const V& q, const V&) { return 1.0 / (exp(-2.0 * q[0]) + exp(-2.0 * q[1])); }}},
               {0.25, 0.5, 1.0});
}

/// A charge between two magnetic mirrors, field 1 + z^2 on the axis.
Scene magnetic_bottle() {
  return scene("magnetic_bottle", false,
               [](const V& q, const V& p) {
                 const Recorded half = 0.5 * (1.0 + square(q[2]));
                 return 0.5 * (square(p[0] + q[1] * half) + square(p[1] - q[0] * half) + square(p[2]));
               },
               {0.5, 0.0, 0.0}, {0.0, -0.45, 1.0}, 60.0,
               {{"field", [](const V& q, const V&) { return 1.0 / (1.0 + square(q[2])); }}}, {0.5, 1.0});
}

}  // namespace

std::vector<Scene> drawn_scenes() {
  std::vector<Scene> scenes;
  for (const auto& make :
       {hill, log_galaxy, isochrone, kepler_polar, schwarzschild, trapped_ions, poschl_teller, bouncing_ball,
        spherical_pendulum, coupled_pendulums, local_modes, magnetic_bottle})
    scenes.push_back(make());
  return scenes;
}

}  // namespace experiment
