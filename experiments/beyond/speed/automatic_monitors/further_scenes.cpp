#include "beyond/speed/automatic_monitors/scenes.hpp"

namespace experiment {

std::vector<Scene> further_scenes() {
  const auto left = [](const V& q) { return square(q[0] + 1.0) + square(q[1]); };
  const auto right = [](const V& q) { return square(q[0] - 1.0) + square(q[1]); };
  std::vector<Scene> scenes;
  scenes.push_back(scene(
      "two_centres", false,
      [=](const V& q, const V& p) { return kinetic(p) - 1.0 / sqrt(left(q)) - 1.0 / sqrt(right(q)); },
      {0.0, 1.2}, {0.35, 0.1}, 20.0,
      {{"potential",
        [=](const V& q, const V&) { return 1.0 / (1.0 / sqrt(left(q)) + 1.0 / sqrt(right(q))); }},
       {"nearest", [=](const V& q, const V&) { return sqrt(left(q) * right(q) / (left(q) + right(q))); }}},
      powers_of_length));
  scenes.push_back(scene(
      "morse", false, [](const V& q, const V& p) { return kinetic(p) + square(1.0 - exp(-q[0])); }, {3.5},
      {0.0}, 100.0, {{"exp", [](const V& q, const V&) { return exp(q[0]); }}}, {0.25, 0.5, 1.0}));
  scenes.push_back(
      scene("double_well", false,
            [](const V& q, const V& p) { return kinetic(p) + 0.25 * square(square(q[0]) - 1.0); }, {1.43},
            {0.0}, 100.0, {{"stiffness", [](const V& q, const V&) { return 1.0 / (1.0 + square(q[0])); }}},
            {0.25, 0.5, 1.0}));
  scenes.push_back(scene(
      "relativistic_kepler", false,
      [](const V& q, const V& p) {
        return 5.0 * sqrt(25.0 + radius_squared(p)) - 1.0 / sqrt(radius_squared(q));
      },
      {2.0, 0.0}, {0.0, 0.35}, 60.0, {radius}, powers_of_length));
  scenes.push_back(scene(
      "elastic_pendulum", false,
      [](const V& q, const V& p) { return kinetic(p) + q[1] + 15.0 * square(sqrt(radius_squared(q)) - 1.0); },
      {0.8, -0.75}, {0.0, 0.0}, 20.0));
  scenes.push_back(scene(
      "channel", false,
      [](const V& q, const V& p) {
        return kinetic(p) + 0.5 * square(q[0] * q[1]) + 0.005 * (square(square(q[0])) + square(square(q[1])));
      },
      {3.0, 0.1}, {0.2, 0.7}, 20.0,
      {{"width", [](const V& q, const V&) { return 1.0 / (1.0 + radius_squared(q)); }}}, {0.25, 0.5}));
  scenes.push_back(scene(
      "diamagnetic_kepler", false,
      [](const V& q, const V& p) {
        return kinetic(p) - 1.0 / sqrt(radius_squared(q)) + 0.2 * (q[0] * p[1] - q[1] * p[0]) +
               0.02 * radius_squared(q);
      },
      {0.15, 0.0}, {0.0, 3.4}, 60.0, {radius}, powers_of_length));
  scenes.push_back(scene(
      "yukawa", false,
      [](const V& q, const V& p) {
        const Recorded r = sqrt(radius_squared(q));
        return kinetic(p) - exp(-0.2 * r) / r;
      },
      {0.08, 0.0}, {0.0, std::sqrt(1.85 / 0.08)}, 60.0, {radius}, powers_of_length));
  scenes.push_back(scene(
      "chain", false,
      [](const V& q, const V& p) {
        Recorded sum = kinetic(p);
        for (Eigen::Index i = 0; i <= q.size(); ++i) {
          const Recorded x = (i < q.size() ? q[i] : Recorded(0.0)) - (i > 0 ? q[i - 1] : Recorded(0.0));
          sum += 0.5 * square(x) + 0.25 * x * x * x;
        }
        return sum;
      },
      {0.15, 0.26, 0.3, 0.26, 0.15}, {0.0, 0.0, 0.0, 0.0, 0.0}, 100.0));
  scenes.push_back(scene("swinging_atwood", false,
                         [](const V& q, const V& p) {
                           return square(p[0]) * 0.125 + 0.5 * square(p[1] / q[0]) + q[0] * (3.0 - cos(q[1]));
                         },
                         {1.0, 0.5 * M_PI}, {0.0, 0.1}, 20.0,
                         {{"r", [](const V& q, const V&) { return q[0]; }}}, {0.5, 1.0, 1.5, 2.0}));
  return scenes;
}

}  // namespace experiment
