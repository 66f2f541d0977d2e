#include "beyond/speed/automatic_monitors/scenes.hpp"

namespace experiment {
namespace {

/// Potential of three particles on a ring with exponential springs, in coordinates of their relative motion.
Recorded toda_potential(const V& q) {
  const double root = 2.0 * std::sqrt(3.0);
  return (exp(2.0 * q[0] + root * q[1]) + exp(2.0 * q[0] - root * q[1]) + exp(-4.0 * q[0])) * (1.0 / 24.0);
}

/// The scenes that were looked at from the beginning.
void add_first(Scenes& scenes) {
  scenes.add("double_pendulum", {1.5, 1.8}, {0.0, 0.0}, 20.0, {}, [](const V& q, const V& p) {
    const Recorded c = cos(q[0] - q[1]);
    return (square(p[0]) + 2.0 * square(p[1]) - 2.0 * p[0] * p[1] * c) / (2.0 * (2.0 - c * c)) -
           2.0 * cos(q[0]) - cos(q[1]);
  });
  scenes.add("henon_heiles", {0.0, 0.3}, {0.45, 0.0}, 62.0, {}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * radius_squared(q) + square(q[0]) * q[1] - q[1] * q[1] * q[1] * (1.0 / 3.0);
  });
  const Scale steep{
      "stiffness", [](const V& q, const V&) { return 1.0 / (1.0 + 40.0 * square(q[0])); }, {0.25, 0.5}};
  scenes.add("stiff_soft", {1.0, 0.1}, {0.0, 0.0}, 12.0, {steep}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * square(q[1]) * (1.0 + 40.0 * square(q[0])) + 0.5 * square(q[0]);
  });
  const Scale bond{"r", distance.scale, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}};
  scenes.add("lennard_jones", {3.0}, {0.0}, 100.0, {bond}, [](const V& q, const V& p) {
    const Recorded s = pow(q[0], -6.0);
    return kinetic(p) + 4.0 * (s * s - s);
  });
  const Scale gap{"gap", [](const V& q, const V&) { return 1.0 - square(q[0]); }, {0.5, 1.0, 1.5, 2.0, 3.0}};
  scenes.add("walls", {0.0}, {1.0}, 60.0, {gap}, [](const V& q, const V& p) {
    return kinetic(p) + 1e-3 * (pow(1.0 - q[0], -2.0) + pow(1.0 + q[0], -2.0));
  });
  const Scale height{"height", [](const V& q, const V&) { return 1.5 + cos(q[0]); }, {-1.0, -0.5, 0.5}};
  scenes.add("separatrix", {3.1}, {0.0}, 100.0, {height},
             [](const V& q, const V& p) { return kinetic(p) - cos(q[0]); });
  scenes.add("quartic", {2.0}, {0.0}, 40.0, {stiffness},
             [](const V& q, const V& p) { return kinetic(p) + 0.25 * square(square(q[0])); });
  const Scale springs{
      "stiffness", [](const V& q, const V&) { return 1.0 / (1.0 + toda_potential(q)); }, {0.25, 0.5, 1.0}};
  scenes.add("toda", {0.0, 0.0}, {3.0, 4.0}, 40.0, {springs},
             [](const V& q, const V& p) { return kinetic(p) + toda_potential(q); });
}

/// Ten scenes that were held out from a first search and have been looked at since.
void add_further(Scenes& scenes) {
  const auto left = [](const V& q) { return square(q[0] + 1.0) + square(q[1]); };
  const auto right = [](const V& q) { return square(q[0] - 1.0) + square(q[1]); };
  const Scale potential{
      "potential", [=](const V& q, const V&) { return 1.0 / (1.0 / sqrt(left(q)) + 1.0 / sqrt(right(q))); }};
  const Scale nearest{"nearest",
                      [=](const V& q, const V&) { return sqrt(left(q) * right(q) / (left(q) + right(q))); }};
  scenes.add("two_centres", {0.0, 1.2}, {0.35, 0.1}, 20.0, {potential, nearest},
             [=](const V& q, const V& p) { return kinetic(p) - 1.0 / sqrt(left(q)) - 1.0 / sqrt(right(q)); });
  const Scale growth{"exp", [](const V& q, const V&) { return exp(q[0]); }, {0.25, 0.5, 1.0}};
  scenes.add("morse", {3.5}, {0.0}, 100.0, {growth},
             [](const V& q, const V& p) { return kinetic(p) + square(1.0 - exp(-q[0])); });
  scenes.add("double_well", {1.43}, {0.0}, 100.0, {stiffness},
             [](const V& q, const V& p) { return kinetic(p) + 0.25 * square(square(q[0]) - 1.0); });
  scenes.add("relativistic_kepler", {2.0, 0.0}, {0.0, 0.35}, 60.0, {radius}, [](const V& q, const V& p) {
    return 5.0 * sqrt(25.0 + radius_squared(p)) - 1.0 / sqrt(radius_squared(q));
  });
  scenes.add("elastic_pendulum", {0.8, -0.75}, {0.0, 0.0}, 20.0, {}, [](const V& q, const V& p) {
    return kinetic(p) + q[1] + 15.0 * square(sqrt(radius_squared(q)) - 1.0);
  });
  const Scale width{
      "width", [](const V& q, const V&) { return 1.0 / (1.0 + radius_squared(q)); }, {0.25, 0.5}};
  scenes.add("channel", {3.0, 0.1}, {0.2, 0.7}, 20.0, {width}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * square(q[0] * q[1]) + 0.005 * (square(square(q[0])) + square(square(q[1])));
  });
  scenes.add("diamagnetic_kepler", {0.15, 0.0}, {0.0, 3.4}, 60.0, {radius}, [](const V& q, const V& p) {
    return kinetic(p) - 1.0 / sqrt(radius_squared(q)) + 0.2 * (q[0] * p[1] - q[1] * p[0]) +
           0.02 * radius_squared(q);
  });
  scenes.add("yukawa", {0.08, 0.0}, {0.0, std::sqrt(1.85 / 0.08)}, 60.0, {radius},
             [](const V& q, const V& p) {
               const Recorded r = sqrt(radius_squared(q));
               return kinetic(p) - exp(-0.2 * r) / r;
             });
  scenes.add("chain", {0.15, 0.26, 0.3, 0.26, 0.15}, {0.0, 0.0, 0.0, 0.0, 0.0}, 100.0, {},
             [](const V& q, const V& p) {
               Recorded sum = kinetic(p);
               for (Eigen::Index i = 0; i <= q.size(); ++i) {
                 const Recorded x =
                     (i < q.size() ? q[i] : Recorded(0.0)) - (i > 0 ? q[i - 1] : Recorded(0.0));
                 sum += 0.5 * square(x) + 0.25 * x * x * x;
               }
               return sum;
             });
  scenes.add("swinging_atwood", {1.0, 0.5 * M_PI}, {0.0, 0.1}, 20.0, {distance}, [](const V& q, const V& p) {
    return square(p[0]) * 0.125 + 0.5 * square(p[1] / q[0]) + q[0] * (3.0 - cos(q[1]));
  });
}

}  // namespace

void add_other(Scenes& scenes) {
  add_first(scenes);
  add_further(scenes);
}

}  // namespace experiment
