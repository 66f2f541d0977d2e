#include "beyond/speed/automatic_monitors/scenes.hpp"

// The rule, laid down before any of these was run: of each class of the other problems (celestial mechanics,
// galaxies, turning frames, relativity, magnetic fields, molecules, ions, walls, pendulums, curved
// coordinates, oscillators) one or two Hamiltonians that textbooks print and no list had; parameters as
// printed there, or 1; starts of one or two digits on a bounded orbit with some ten of its periods. None was
// taken out, changed or added later, and the menu and the pilot were final.

namespace experiment {

namespace {

/// A comet of eccentricity 0.9 inside of the orbit of a planet.
Scene comet() {
  const std::vector<double> m{1.0, 1e-3, 1e-6};
  return scene(
      "comet", true, [=](const V& q, const V& p) { return kinetic(p, m) - pairs(q, m, 1.0); },
      {0.0, 0.0, 5.0, 0.0, 0.1, 0.0},
      {0.0, 0.0, 0.0, 1e-3 * std::sqrt(0.2), 0.0, 1e-6 * std::sqrt(1.9 / 0.1)}, 20.0 * M_PI,
      pair_lengths({1.0, 1.0, 1.0}), powers_of_length);
}

/// A satellite over the poles of an oblate planet (Brouwer 1959), eccentricity 0.8.
Scene satellite() {
  return scene(
      "satellite", true,
      [](const V& q, const V& p) {
        const Recorded s = radius_squared(q);
        return kinetic(p) - (1.0 - 0.0005 / s * (3.0 * square(q[1]) / s - 1.0)) / sqrt(s);
      },
      {0.2, 0.0}, {0.0, std::sqrt(1.8 / 0.2)}, 20.0 * M_PI, {radius}, powers_of_length);
}

/// The meridian plane of a disc galaxy (Miyamoto and Nagai 1975).
Scene disc_galaxy() {
  const auto thickness = [](const V& q) { return sqrt(square(q[1]) + 0.01); };
  return scene(
      "disc_galaxy", true,
      [=](const V& q, const V& p) {
        return kinetic(p) + 0.02 / square(q[0]) - 1.0 / sqrt(square(q[0]) + square(1.0 + thickness(q)));
      },
      {1.5, 0.0}, {0.0, 0.3}, 100.0,
      {{"R", [](const V& q, const V&) { return q[0]; }},
       {"thickness", [=](const V& q, const V&) { return thickness(q); }}},
      powers_of_length);
}

/// A star in a turning logarithmic bar (Binney and Tremaine 2008, Section 3.3.2).
Scene bar() {
  const auto inner = [](const V& q) { return 0.05 * 0.05 + square(q[0]) + square(q[1]) * (1.0 / 0.64); };
  return scene(
      "bar", true,
      [=](const V& q, const V& p) {
        return kinetic(p) - 0.5 * (q[0] * p[1] - q[1] * p[0]) + 0.5 * log(inner(q));
      },
      {0.4, 0.0}, {0.0, 0.2}, 20.0, {{"core", [=](const V& q, const V&) { return sqrt(inner(q)); }}},
      powers_of_length);
}

/// A fast oscillator in special relativity.
Scene relativistic_oscillator() {
  return scene("relativistic_oscillator", true,
               [](const V& q, const V& p) { return sqrt(1.0 + square(p[0])) + 0.5 * square(q[0]); }, {5.0},
               {0.0}, 200.0, {{"gamma", [](const V&, const V& p) { return sqrt(1.0 + square(p[0])); }}},
               {-1.0, -0.5, 0.5, 1.0});
}

/// Stormer's problem in the meridian plane: a charge that is mirrored in a dipole's field.
Scene stormer() {
  const auto distance = [](const V& q) { return sqrt(radius_squared(q)); };
  return scene("stormer", true,
               [=](const V& q, const V& p) {
                 return kinetic(p) + 0.5 * square(1.0 / q[0] - q[0] * pow(radius_squared(q), -1.5));
               },
               {1.0, 0.0}, {0.05, 0.15}, 100.0, {{"r", [=](const V& q, const V&) { return distance(q); }}},
               {1.0, 2.0, 3.0});
}

/// Kratzer's molecule.
Scene kratzer() {
  return scene(
      "kratzer", true,
      [](const V& q, const V& p) { return kinetic(p) - 2.0 * (1.0 / q[0] - 0.5 / square(q[0])); }, {6.0},
      {0.0}, 270.0, {{"r", [](const V& q, const V&) { return q[0]; }}}, powers_of_length);
}

/// The relative motion of two ions in a trap, nearly head-on.
Scene two_ions() {
  return scene(
      "two_ions", true,
      [](const V& q, const V& p) {
        return kinetic(p) + 0.5 * (square(q[0]) + 4.0 * square(q[1])) + 1.0 / sqrt(radius_squared(q));
      },
      {2.0, 0.1}, {0.0, 0.0}, 60.0, {radius}, powers_of_length);
}

/// A ball in a box with exponential walls.
Scene soft_box() {
  const auto walls = [](const V& q) { return exp(-40.0 * (1.0 + q[0])) + exp(-40.0 * (1.0 - q[0])); };
  return scene("soft_box", true, [=](const V& q, const V& p) { return kinetic(p) + walls(q); }, {0.0}, {1.0},
               40.0, {{"hardness", [=](const V& q, const V&) { return 1.0 / (1.0 + walls(q)); }}},
               {0.25, 0.5, 1.0});
}

/// A pendulum on a cart of the same mass.
Scene cart() {
  return scene(
      "cart", true,
      [](const V& q, const V& p) {
        const Recorded c = cos(q[1]);
        return (square(p[0]) - 2.0 * p[0] * p[1] * c + 2.0 * square(p[1])) / (2.0 * (2.0 - c * c)) - c;
      },
      {0.0, 3.0}, {0.0, 0.0}, 60.0);
}

/// The nutation of a heavy top (Goldstein 1980, Section 5-7).
Scene top() {
  return scene(
      "top", true,
      [](const V& q, const V& p) {
        return kinetic(p) + 0.5 * square((1.2 - cos(q[0])) / sin(q[0])) + cos(q[0]);
      },
      {0.6}, {0.0}, 60.0, {{"sine", [](const V& q, const V&) { return sin(q[0]); }}}, powers_of_length);
}

/// Barbanis' oscillators.
Scene barbanis() {
  return scene(
      "barbanis", true,
      [](const V& q, const V& p) { return kinetic(p) + 0.5 * radius_squared(q) + square(q[0]) * q[1]; },
      {0.3, 0.1}, {0.1, 0.2}, 62.0);
}

}  // namespace

std::vector<Scene> held_out_scenes() {
  std::vector<Scene> scenes;
  for (const auto& make : {comet, satellite, disc_galaxy, bar, relativistic_oscillator, stormer, kratzer,
                           two_ions, soft_box, cart, top, barbanis})
    scenes.push_back(make());
  return scenes;
}

}  // namespace experiment
