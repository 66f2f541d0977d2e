#include "beyond/speed/automatic_monitors/scenes.hpp"

namespace experiment {

namespace {

constexpr double period = 2.0 * M_PI;

Scene kepler(double e) {
  std::string name = "kepler_" + std::to_string(e);
  name.erase(name.find_last_not_of("0.") + 1);
  return scene(
      e == 0.0 ? "kepler_0" : name, false,
      [](const V& q, const V& p) { return kinetic(p) - 1.0 / sqrt(radius_squared(q)); }, {1.0 - e, 0.0},
      {0.0, std::sqrt((1.0 + e) / (1.0 - e))}, 10.0 * period, {radius}, powers_of_length);
}

/// An inner pair of eccentricity 0.9 and a third body on a wide circle.
Scene triple() {
  const std::vector<double> m{0.5, 0.5, 0.5};
  const double distance = 8.0, speed = std::sqrt(1.5 / distance), v = std::sqrt(1.9 / 0.1);
  return scene(
      "triple", false, [=](const V& q, const V& p) { return kinetic(p, m) - pairs(q, m, 1.0); },
      {-distance / 3.0 + 0.05, 0.0, -distance / 3.0 - 0.05, 0.0, 2.0 * distance / 3.0, 0.0},
      {0.0, 0.5 * (-speed / 3.0 + 0.5 * v), 0.0, 0.5 * (-speed / 3.0 - 0.5 * v), 0.0,
       0.5 * 2.0 * speed / 3.0},
      10.0 * period, pair_lengths(m), powers_of_length);
}

/// A light planet of eccentricity 0.7 about one star of a circular binary.
Scene planet_in_binary() {
  const std::vector<double> m{0.5, 0.5, 1e-3};
  const double speed = 0.5, a = 0.6, r = 0.3 * a, v = std::sqrt(0.5 * 1.7 / r);
  return scene(
      "planet_in_binary", false, [=](const V& q, const V& p) { return kinetic(p, m) - pairs(q, m, 1.0); },
      {2.0, 0.0, -2.0, 0.0, 2.0 + r, 0.0},
      {0.0, 0.25 * speed, 0.0, -0.25 * speed, 0.0, 1e-3 * (0.5 * speed + v)},
      10.0 * period * std::sqrt(a * a * a / 0.5), pair_lengths({1.0, 1.0, 1.0}), powers_of_length);
}

Scene figure_eight() {
  const std::vector<double> m{1.0, 1.0, 1.0};
  const double x = 0.93240737, y = 0.86473146;
  return scene(
      "figure_eight", false, [=](const V& q, const V& p) { return kinetic(p) - pairs(q, m, 1.0); },
      {0.97000436, -0.24308753, -0.97000436, 0.24308753, 0.0, 0.0},
      {0.5 * x, 0.5 * y, 0.5 * x, 0.5 * y, -x, -y}, 4.0 * 6.32591398, pair_lengths(m), powers_of_length);
}

/// A binary of eccentricity 0.6 and a light body on its axis, with their own motions as coordinates.
Scene sitnikov() {
  const Scale nearest{"star",
                      [](const V& q, const V&) { return sqrt(square(q[2]) + 0.25 * radius_squared(q)); }};
  return scene(
      "sitnikov", false,
      [](const V& q, const V& p) {
        const Recorded r = radius_squared(q);
        return 0.5 * (square(p[0]) + square(p[1])) - 1.0 / sqrt(r) + square(p[2]) * 500.0 -
               1e-3 / sqrt(square(q[2]) + 0.25 * r);
      },
      {0.4, 0.0, 0.3}, {0.0, 2.0, 0.0}, 10.0 * period, {radius, nearest}, powers_of_length);
}

/// Arenstorf's periodic orbit of the restricted problem, in the turning frame.
Scene restricted_three() {
  const double mu = 0.012277471;
  const auto earth = [=](const V& q) { return square(q[0] + mu) + square(q[1]); };
  const auto moon = [=](const V& q) { return square(q[0] - (1.0 - mu)) + square(q[1]); };
  const Scale potential{"potential", [=](const V& q, const V&) {
                          return 1.0 / ((1.0 - mu) / sqrt(earth(q)) + mu / sqrt(moon(q)));
                        }};
  const Scale nearest{"nearest",
                      [=](const V& q, const V&) { return sqrt(earth(q) * moon(q) / (earth(q) + moon(q))); }};
  const Scale tide{"tide", [=](const V& q, const V&) {
                     return pow((1.0 - mu) * pow(earth(q), -1.5) + mu * pow(moon(q), -1.5), -1.0 / 3.0);
                   }};
  return scene(
      "restricted_three", false,
      [=](const V& q, const V& p) {
        return kinetic(p) + q[1] * p[0] - q[0] * p[1] - (1.0 - mu) / sqrt(earth(q)) - mu / sqrt(moon(q));
      },
      {0.994, 0.0}, {0.0, -2.00158510637908 + 0.994}, 17.0652165601579625, {potential, nearest, tide},
      powers_of_length);
}

Scene dipole() {
  const Scale distance{"r", [](const V& q, const V&) { return sqrt(radius_squared(q) + square(q[2])); }};
  const double w = std::pow(0.4 * 0.4 + 0.05 * 0.05, -1.5);
  return scene("dipole", false,
               [](const V& q, const V& p) {
                 const Recorded field = pow(radius_squared(q) + square(q[2]), -1.5);
                 return 0.5 * (square(p[0] + q[1] * field) + square(p[1] - q[0] * field) + square(p[2]));
               },
               {0.4, 0.0, 0.05}, {0.2, 0.4 * w + 0.1, 0.3}, 30.0, {distance}, {1.0, 1.5, 2.0, 3.0, 4.0});
}

}  // namespace

std::vector<Scene> celestial_scenes() {
  std::vector<Scene> scenes;
  for (const double e : {0.0, 0.5, 0.9, 0.99, 0.999})
    scenes.push_back(kepler(e));
  scenes.push_back(scene(
      "quadrupole", false,
      [](const V& q, const V& p) {
        const Recorded s = radius_squared(q);
        return kinetic(p) - (1.0 + 0.0005 / s) / sqrt(s);
      },
      {0.1, 0.0}, {0.0, std::sqrt(1.9 / 0.1)}, 10.0 * period, {radius}, powers_of_length));
  scenes.push_back(triple());
  scenes.push_back(planet_in_binary());
  scenes.push_back(figure_eight());
  scenes.push_back(sitnikov());
  scenes.push_back(restricted_three());
  scenes.push_back(dipole());
  return scenes;
}

}  // namespace experiment
