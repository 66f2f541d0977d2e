#include "beyond/speed/automatic_monitors/scenes.hpp"

namespace experiment {

namespace {

/// Three particles on a ring with exponential springs, in the coordinates of their relative motion.
Recorded toda_potential(const V& q) {
  const double root = 2.0 * std::sqrt(3.0);
  return (exp(2.0 * q[0] + root * q[1]) + exp(2.0 * q[0] - root * q[1]) + exp(-4.0 * q[0])) * (1.0 / 24.0);
}

}  // namespace

std::vector<Scene> other_scenes() {
  const Scale distance{"r", [](const V& q, const V&) { return q[0]; }};
  std::vector<Scene> scenes;
  scenes.push_back(scene(
      "double_pendulum", false,
      [](const V& q, const V& p) {
        const Recorded c = cos(q[0] - q[1]);
        return (square(p[0]) + 2.0 * square(p[1]) - 2.0 * p[0] * p[1] * c) / (2.0 * (2.0 - c * c)) -
               2.0 * cos(q[0]) - cos(q[1]);
      },
      {1.5, 1.8}, {0.0, 0.0}, 20.0));
  scenes.push_back(scene(
      "henon_heiles", false,
      [](const V& q, const V& p) {
        return kinetic(p) + 0.5 * radius_squared(q) + square(q[0]) * q[1] - q[1] * q[1] * q[1] * (1.0 / 3.0);
      },
      {0.0, 0.3}, {0.45, 0.0}, 62.0));
  scenes.push_back(scene(
      "stiff_soft", false,
      [](const V& q, const V& p) {
        return kinetic(p) + 0.5 * square(q[1]) * (1.0 + 40.0 * square(q[0])) + 0.5 * square(q[0]);
      },
      {1.0, 0.1}, {0.0, 0.0}, 12.0,
      {{"stiffness", [](const V& q, const V&) { return 1.0 / (1.0 + 40.0 * square(q[0])); }}}, {0.25, 0.5}));
  scenes.push_back(scene("lennard_jones", false,
                         [](const V& q, const V& p) {
                           const Recorded s = pow(q[0], -6.0);
                           return kinetic(p) + 4.0 * (s * s - s);
                         },
                         {3.0}, {0.0}, 100.0, {distance}, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}));
  scenes.push_back(scene("walls", false,
                         [](const V& q, const V& p) {
                           return kinetic(p) + 1e-3 * (pow(1.0 - q[0], -2.0) + pow(1.0 + q[0], -2.0));
                         },
                         {0.0}, {1.0}, 60.0,
                         {{"gap", [](const V& q, const V&) { return 1.0 - square(q[0]); }}},
                         {0.5, 1.0, 1.5, 2.0, 3.0}));
  scenes.push_back(
      scene("separatrix", false, [](const V& q, const V& p) { return kinetic(p) - cos(q[0]); }, {3.1}, {0.0},
            100.0, {{"height", [](const V& q, const V&) { return 1.5 + cos(q[0]); }}}, {-1.0, -0.5, 0.5}));
  scenes.push_back(scene(
      "quartic", false, [](const V& q, const V& p) { return kinetic(p) + 0.25 * square(square(q[0])); },
      {2.0}, {0.0}, 40.0, {{"stiffness", [](const V& q, const V&) { return 1.0 / (1.0 + square(q[0])); }}},
      {0.25, 0.5, 1.0}));
  scenes.push_back(scene(
      "toda", false, [](const V& q, const V& p) { return kinetic(p) + toda_potential(q); }, {0.0, 0.0},
      {3.0, 4.0}, 40.0, {{"stiffness", [](const V& q, const V&) { return 1.0 / (1.0 + toda_potential(q)); }}},
      {0.25, 0.5, 1.0}));
  return scenes;
}

}  // namespace experiment
