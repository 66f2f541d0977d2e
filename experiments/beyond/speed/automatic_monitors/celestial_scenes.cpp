#include "beyond/speed/automatic_monitors/scenes.hpp"

namespace experiment {
namespace {

constexpr double period = 2.0 * M_PI;

void add_keplers(Scenes& scenes) {
  for (const double e : {0.0, 0.5, 0.9, 0.99, 0.999})
    scenes.add(fmt::format("kepler_{:g}", e), {1.0 - e, 0.0}, {0.0, std::sqrt((1.0 + e) / (1.0 - e))},
               10.0 * period, {radius},
               [](const V& q, const V& p) { return kinetic(p) - 1.0 / sqrt(radius_squared(q)); });
  scenes.add("quadrupole", {0.1, 0.0}, {0.0, std::sqrt(1.9 / 0.1)}, 10.0 * period, {radius},
             [](const V& q, const V& p) {
               const Recorded s = radius_squared(q);
               return kinetic(p) - (1.0 + 0.0005 / s) / sqrt(s);
             });
}

void add_three_bodies(Scenes& scenes) {
  const std::vector<double> unit{1.0, 1.0, 1.0};
  {
    // An inner pair with eccentricity 0.9, and a third body on a wide circular orbit.
    const std::vector<double> m{0.5, 0.5, 0.5};
    const double apart = 8.0, speed = std::sqrt(1.5 / apart), v = std::sqrt(1.9 / 0.1);
    scenes.add("triple", {-apart / 3.0 + 0.05, 0.0, -apart / 3.0 - 0.05, 0.0, 2.0 * apart / 3.0, 0.0},
               {0.0, 0.5 * (-speed / 3.0 + 0.5 * v), 0.0, 0.5 * (-speed / 3.0 - 0.5 * v), 0.0,
                0.5 * 2.0 * speed / 3.0},
               10.0 * period, pair_lengths(m),
               [=](const V& q, const V& p) { return kinetic(p, m) - pairs(q, m, 1.0); });
  }
  {
    // A light planet with eccentricity 0.7 around one star of a circular binary.
    const std::vector<double> m{0.5, 0.5, 1e-3};
    const double speed = 0.5, a = 0.6, r = 0.3 * a, v = std::sqrt(0.5 * 1.7 / r);
    scenes.add("planet_in_binary", {2.0, 0.0, -2.0, 0.0, 2.0 + r, 0.0},
               {0.0, 0.25 * speed, 0.0, -0.25 * speed, 0.0, 1e-3 * (0.5 * speed + v)},
               10.0 * period * std::sqrt(a * a * a / 0.5), pair_lengths(unit),
               [=](const V& q, const V& p) { return kinetic(p, m) - pairs(q, m, 1.0); });
  }
  const double x = 0.93240737, y = 0.86473146;
  scenes.add("figure_eight", {0.97000436, -0.24308753, -0.97000436, 0.24308753, 0.0, 0.0},
             {0.5 * x, 0.5 * y, 0.5 * x, 0.5 * y, -x, -y}, 4.0 * 6.32591398, pair_lengths(unit),
             [=](const V& q, const V& p) { return kinetic(p) - pairs(q, unit, 1.0); });
}

/// A binary of eccentricity 0.6 and a light body on its axis; the motion of the binary is part of the
/// coordinates.
void add_sitnikov(Scenes& scenes) {
  const Scale star{"star",
                   [](const V& q, const V&) { return sqrt(square(q[2]) + 0.25 * radius_squared(q)); }};
  scenes.add("sitnikov", {0.4, 0.0, 0.3}, {0.0, 2.0, 0.0}, 10.0 * period, {radius, star},
             [](const V& q, const V& p) {
               const Recorded r = radius_squared(q);
               return 0.5 * (square(p[0]) + square(p[1])) - 1.0 / sqrt(r) + square(p[2]) * 500.0 -
                      1e-3 / sqrt(square(q[2]) + 0.25 * r);
             });
}

/// Arenstorf's periodic orbit in the restricted three-body problem, in the rotating frame.
void add_restricted_three(Scenes& scenes) {
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
  scenes.add("restricted_three", {0.994, 0.0}, {0.0, -2.00158510637908 + 0.994}, 17.0652165601579625,
             {potential, nearest, tide}, [=](const V& q, const V& p) {
               return kinetic(p) + q[1] * p[0] - q[0] * p[1] - (1.0 - mu) / sqrt(earth(q)) -
                      mu / sqrt(moon(q));
             });
}

void add_dipole(Scenes& scenes) {
  const double w = std::pow(0.4 * 0.4 + 0.05 * 0.05, -1.5);
  const Scale r{"r",
                [](const V& q, const V&) { return sqrt(radius_squared(q) + square(q[2])); },
                {1.0, 1.5, 2.0, 3.0, 4.0}};
  scenes.add("dipole", {0.4, 0.0, 0.05}, {0.2, 0.4 * w + 0.1, 0.3}, 30.0, {r}, [](const V& q, const V& p) {
    const Recorded field = pow(radius_squared(q) + square(q[2]), -1.5);
    return 0.5 * (square(p[0] + q[1] * field) + square(p[1] - q[0] * field) + square(p[2]));
  });
}

}  // namespace

void add_celestial(Scenes& scenes) {
  add_keplers(scenes);
  add_three_bodies(scenes);
  add_sitnikov(scenes);
  add_restricted_three(scenes);
  add_dipole(scenes);
}

}  // namespace experiment
