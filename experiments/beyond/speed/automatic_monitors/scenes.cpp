#include "beyond/speed/automatic_monitors/scenes.hpp"

namespace experiment {

void add_celestial(Scenes& scenes) {
  constexpr double period = 2.0 * M_PI;
  for (const double e : {0.0, 0.5, 0.9, 0.99, 0.999})
    scenes.add(fmt::format("kepler_{:g}", e), {1.0 - e, 0.0}, {0.0, std::sqrt((1.0 + e) / (1.0 - e))},
               10.0 * period, {radius},
               [](const V& q, const V& p) { return kinetic(p) - 1.0 / sqrt(radius_squared(q)); });
  scenes.add("quadrupole", {0.1, 0.0}, {0.0, std::sqrt(1.9 / 0.1)}, 10.0 * period, {radius},
             [](const V& q, const V& p) {
               const Recorded s = radius_squared(q);
               return kinetic(p) - (1.0 + 0.0005 / s) / sqrt(s);
             });
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
  // A binary of eccentricity 0.6 and a light body on its axis; the motion of the binary is part of the
  // coordinates.
  const Scale star{"star", [](const V& q) { return sqrt(square(q[2]) + 0.25 * radius_squared(q)); }};
  scenes.add("sitnikov", {0.4, 0.0, 0.3}, {0.0, 2.0, 0.0}, 10.0 * period, {radius, star},
             [](const V& q, const V& p) {
               const Recorded r = radius_squared(q);
               return 0.5 * (square(p[0]) + square(p[1])) - 1.0 / sqrt(r) + square(p[2]) * 500.0 -
                      1e-3 / sqrt(square(q[2]) + 0.25 * r);
             });
  // Arenstorf's periodic orbit in the restricted three-body problem, in the rotating frame.
  const double mu = 0.012277471;
  const auto earth = [=](const V& q) { return square(q[0] + mu) + square(q[1]); };
  const auto moon = [=](const V& q) { return square(q[0] - (1.0 - mu)) + square(q[1]); };
  const Scale potential{"potential",
                        [=](const V& q) { return 1.0 / ((1.0 - mu) / sqrt(earth(q)) + mu / sqrt(moon(q))); }};
  const Scale nearest{"nearest", [=](const V& q) { return sqrt(earth(q) * moon(q) / (earth(q) + moon(q))); }};
  const Scale tide{"tide", [=](const V& q) {
                     return pow((1.0 - mu) * pow(earth(q), -1.5) + mu * pow(moon(q), -1.5), -1.0 / 3.0);
                   }};
  scenes.add("restricted_three", {0.994, 0.0}, {0.0, -2.00158510637908 + 0.994}, 17.0652165601579625,
             {potential, nearest, tide}, [=](const V& q, const V& p) {
               return kinetic(p) + q[1] * p[0] - q[0] * p[1] - (1.0 - mu) / sqrt(earth(q)) -
                      mu / sqrt(moon(q));
             });
  // A charge in the field of a dipole.
  const double w = std::pow(0.4 * 0.4 + 0.05 * 0.05, -1.5);
  const Scale r{
      "r", [](const V& q) { return sqrt(radius_squared(q) + square(q[2])); }, {1.0, 1.5, 2.0, 3.0, 4.0}};
  scenes.add("dipole", {0.4, 0.0, 0.05}, {0.2, 0.4 * w + 0.1, 0.3}, 30.0, {r}, [](const V& q, const V& p) {
    const Recorded field = pow(radius_squared(q) + square(q[2]), -1.5);
    return 0.5 * (square(p[0] + q[1] * field) + square(p[1] - q[0] * field) + square(p[2]));
  });
}

/// Potential of three particles on a ring with exponential springs, in coordinates of their relative motion.
static Recorded toda_potential(const V& q) {
  const double root = 2.0 * std::sqrt(3.0);
  return (exp(2.0 * q[0] + root * q[1]) + exp(2.0 * q[0] - root * q[1]) + exp(-4.0 * q[0])) * (1.0 / 24.0);
}

void add_first(Scenes& scenes) {
  scenes.add("double_pendulum", {1.5, 1.8}, {0.0, 0.0}, 20.0, {}, [](const V& q, const V& p) {
    const Recorded c = cos(q[0] - q[1]);
    return (square(p[0]) + 2.0 * square(p[1]) - 2.0 * p[0] * p[1] * c) / (2.0 * (2.0 - c * c)) -
           2.0 * cos(q[0]) - cos(q[1]);
  });
  scenes.add("henon_heiles", {0.0, 0.3}, {0.45, 0.0}, 62.0, {}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * radius_squared(q) + square(q[0]) * q[1] - q[1] * q[1] * q[1] * (1.0 / 3.0);
  });
  const Scale steep{"stiffness", [](const V& q) { return 1.0 / (1.0 + 40.0 * square(q[0])); }, {0.25, 0.5}};
  scenes.add("stiff_soft", {1.0, 0.1}, {0.0, 0.0}, 12.0, {steep}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * square(q[1]) * (1.0 + 40.0 * square(q[0])) + 0.5 * square(q[0]);
  });
  const Scale bond{"r", distance.scale, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}};
  scenes.add("lennard_jones", {3.0}, {0.0}, 100.0, {bond}, [](const V& q, const V& p) {
    const Recorded s = pow(q[0], -6.0);
    return kinetic(p) + 4.0 * (s * s - s);
  });
  const Scale gap{"gap", [](const V& q) { return 1.0 - square(q[0]); }, {0.5, 1.0, 1.5, 2.0, 3.0}};
  scenes.add("walls", {0.0}, {1.0}, 60.0, {gap}, [](const V& q, const V& p) {
    return kinetic(p) + 1e-3 * (pow(1.0 - q[0], -2.0) + pow(1.0 + q[0], -2.0));
  });
  const Scale height{"height", [](const V& q) { return 1.5 + cos(q[0]); }, {-1.0, -0.5, 0.5}};
  scenes.add("separatrix", {3.1}, {0.0}, 100.0, {height},
             [](const V& q, const V& p) { return kinetic(p) - cos(q[0]); });
  scenes.add("quartic", {2.0}, {0.0}, 40.0, {stiffness},
             [](const V& q, const V& p) { return kinetic(p) + 0.25 * square(square(q[0])); });
  const Scale springs{
      "stiffness", [](const V& q) { return 1.0 / (1.0 + toda_potential(q)); }, {0.25, 0.5, 1.0}};
  scenes.add("toda", {0.0, 0.0}, {3.0, 4.0}, 40.0, {springs},
             [](const V& q, const V& p) { return kinetic(p) + toda_potential(q); });
}

void add_further(Scenes& scenes) {
  const auto left = [](const V& q) { return square(q[0] + 1.0) + square(q[1]); };
  const auto right = [](const V& q) { return square(q[0] - 1.0) + square(q[1]); };
  const Scale potential{"potential",
                        [=](const V& q) { return 1.0 / (1.0 / sqrt(left(q)) + 1.0 / sqrt(right(q))); }};
  const Scale nearest{"nearest", [=](const V& q) { return sqrt(left(q) * right(q) / (left(q) + right(q))); }};
  scenes.add("two_centres", {0.0, 1.2}, {0.35, 0.1}, 20.0, {potential, nearest},
             [=](const V& q, const V& p) { return kinetic(p) - 1.0 / sqrt(left(q)) - 1.0 / sqrt(right(q)); });
  const Scale growth{"exp", [](const V& q) { return exp(q[0]); }, {0.25, 0.5, 1.0}};
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
  const Scale width{"width", [](const V& q) { return 1.0 / (1.0 + radius_squared(q)); }, {0.25, 0.5}};
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

// These problems were drawn by a rule laid down before any of them was run. Each class of the other problems
// (celestial mechanics, galaxies, rotating frames, relativity, magnetic fields, molecules, ions, walls,
// pendulums, curved coordinates, oscillators) contributes one or two Hamiltonians that are printed in
// textbooks and were in no list. Parameters are as printed there, or 1; starts have one or two digits, on a
// bounded orbit, over about ten of its periods. None was removed, changed or added later. The menu and the
// pilot were final when these were run, except that the first twelve were run with an earlier menu; those
// twelve have been looked at since.

void add_seen(Scenes& scenes) {
  // Hill's lunar problem (Szebehely 1967): a moon with eccentricity 0.6, which leaves its planet after one
  // revolution.
  scenes.add("hill", {0.1, 0.0}, {0.0, 4.1}, 10.0, {radius}, [](const V& q, const V& p) {
    return kinetic(p) + q[1] * p[0] - q[0] * p[1] - 1.0 / sqrt(radius_squared(q)) - square(q[0]) +
           0.5 * square(q[1]);
  });
  // A star on a box orbit of the logarithmic potential (Binney and Tremaine 2008, Section 3.3).
  const auto inner = [](const V& q) { return 0.14 * 0.14 + square(q[0]) + square(q[1]) * (1.0 / 0.81); };
  const Scale galaxy{"core", [=](const V& q) { return sqrt(inner(q)); }};
  scenes.add("log_galaxy", {0.5, 0.0}, {0.7, 0.4}, 30.0, {galaxy},
             [=](const V& q, const V& p) { return kinetic(p) + 0.5 * log(inner(q)); });
  // A nearly radial orbit of Henon's isochrone.
  const Scale core{"core", [](const V& q) { return sqrt(1.0 + radius_squared(q)); }};
  scenes.add("isochrone", {3.0, 0.0}, {0.0, 0.1}, 100.0, {core},
             [](const V& q, const V& p) { return kinetic(p) - 1.0 / (1.0 + sqrt(1.0 + radius_squared(q))); });
  // Kepler's problem, e = 0.9, in polar coordinates.
  scenes.add("kepler_polar", {0.1, 0.0}, {0.0, std::sqrt(0.19)}, 20.0 * M_PI, {distance},
             [](const V& q, const V& p) {
               return 0.5 * square(p[0]) + 0.5 * square(p[1]) / square(q[0]) - 1.0 / q[0];
             });
  // The radial motion of a free fall around a black hole of mass 1 (Misner, Thorne and Wheeler 1973, Chapter
  // 25), in proper time: angular momentum 4, starting at r = 30 with zero radial velocity.
  const double energy_squared = (1.0 - 2.0 / 30.0) * (1.0 + 16.0 / 900.0);
  const auto redshift = [](const V& q) { return 1.0 - 2.0 / q[0]; };
  const Scale outside{"outside", [](const V& q) { return q[0] - 2.0; }};
  scenes.add("schwarzschild", {30.0}, {0.0}, 3000.0, {distance, outside}, [=](const V& q, const V& p) {
    return 0.5 * (redshift(q) * square(p[0]) - energy_squared / redshift(q) + 16.0 / square(q[0]));
  });
  // Three ions on the axis of a trap.
  const auto sum = [](const V& q, double k) {
    return pow(q[1] - q[0], -k) + pow(q[2] - q[1], -k) + pow(q[2] - q[0], -k);
  };
  const Scale gaps1{"gaps1", [=](const V& q) { return 1.0 / sum(q, 1.0); }};
  const Scale gaps3{"gaps3", [=](const V& q) { return pow(sum(q, 3.0), -1.0 / 3.0); }};
  scenes.add("trapped_ions", {-1.5, 0.2, 1.2}, {0.0, 0.0, 0.0}, 60.0, {gaps1, gaps3},
             [=](const V& q, const V& p) {
               return kinetic(p) + 0.5 * (radius_squared(q) + square(q[2])) + sum(q, 1.0);
             });
  // The Poschl-Teller well.
  const Scale catenary{"cosh", [](const V& q) { return cosh(q[0]); }, {0.5, 1.0, 2.0}};
  scenes.add("poschl_teller", {2.5}, {0.0}, 50.0, {catenary},
             [](const V& q, const V& p) { return kinetic(p) - 10.0 * pow(cosh(q[0]), -2.0); });
  // A ball that falls onto a floor with exponential repulsion.
  const Scale floor{"hardness", [](const V& q) { return 1.0 / (1.0 + exp(-30.0 * q[0])); }, {0.25, 0.5, 1.0}};
  scenes.add("bouncing_ball", {1.0}, {0.0}, 40.0, {floor},
             [](const V& q, const V& p) { return kinetic(p) + q[0] + exp(-30.0 * q[0]); });
  // A spherical pendulum in angles. It passes close to its lowest point, a pole of the coordinates.
  scenes.add("spherical_pendulum", {2.0, 0.0}, {0.0, 0.1}, 40.0, {sine}, [](const V& q, const V& p) {
    return 0.5 * square(p[0]) + 0.5 * square(p[1] / sin(q[0])) - cos(q[0]);
  });
  // Four pendulums in a row, coupled by springs, one of them lifted nearly to the top.
  scenes.add("coupled_pendulums", {3.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 50.0, {},
             [](const V& q, const V& p) {
               Recorded h = kinetic(p);
               for (Eigen::Index i = 0; i < q.size(); ++i) {
                 h -= cos(q[i]);
                 if (i > 0) h += 0.25 * square(q[i] - q[i - 1]);
               }
               return h;
             });
  // The two bonds of a bent molecule (Child and Lawton 1981).
  const Scale bonds{
      "bonds", [](const V& q) { return 1.0 / (exp(-2.0 * q[0]) + exp(-2.0 * q[1])); }, {0.25, 0.5, 1.0}};
  scenes.add("local_modes", {1.5, 0.0}, {0.0, 0.0}, 60.0, {bonds}, [](const V& q, const V& p) {
    return kinetic(p) - 0.1 * (p[0] * p[1]) + square(1.0 - exp(-q[0])) + square(1.0 - exp(-q[1]));
  });
  // A charge between two magnetic mirrors, with field 1 + z^2 on the axis.
  const Scale field{"field", [](const V& q) { return 1.0 / (1.0 + square(q[2])); }, {0.5, 1.0}};
  scenes.add("magnetic_bottle", {0.5, 0.0, 0.0}, {0.0, -0.45, 1.0}, 60.0, {field},
             [](const V& q, const V& p) {
               const Recorded half = 0.5 * (1.0 + square(q[2]));
               return 0.5 * (square(p[0] + q[1] * half) + square(p[1] - q[0] * half) + square(p[2]));
             });
}

void add_held_out(Scenes& scenes) {
  scenes.held_out = true;
  // A comet with eccentricity 0.9 inside the orbit of a planet.
  const std::vector<double> m{1.0, 1e-3, 1e-6};
  scenes.add("comet", {0.0, 0.0, 5.0, 0.0, 0.1, 0.0},
             {0.0, 0.0, 0.0, 1e-3 * std::sqrt(0.2), 0.0, 1e-6 * std::sqrt(1.9 / 0.1)}, 20.0 * M_PI,
             pair_lengths({1.0, 1.0, 1.0}),
             [=](const V& q, const V& p) { return kinetic(p, m) - pairs(q, m, 1.0); });
  // A satellite in polar orbit around an oblate planet (Brouwer 1959), eccentricity 0.8.
  scenes.add("satellite", {0.2, 0.0}, {0.0, std::sqrt(1.8 / 0.2)}, 20.0 * M_PI, {radius},
             [](const V& q, const V& p) {
               const Recorded s = radius_squared(q);
               return kinetic(p) - (1.0 - 0.0005 / s * (3.0 * square(q[1]) / s - 1.0)) / sqrt(s);
             });
  // The meridian plane of a disc galaxy (Miyamoto and Nagai 1975).
  const auto thick = [](const V& q) { return sqrt(square(q[1]) + 0.01); };
  const Scale R{"R", distance.scale}, thickness{"thickness", [=](const V&q) { return thick(q); }};
  scenes.add("disc_galaxy", {1.5, 0.0}, {0.0, 0.3}, 100.0, {R, thickness}, [=](const V& q, const V& p) {
    return kinetic(p) + 0.02 / square(q[0]) - 1.0 / sqrt(square(q[0]) + square(1.0 + thick(q)));
  });
  // A star in a rotating logarithmic bar (Binney and Tremaine 2008, Section 3.3.2).
  const auto inner = [](const V& q) { return 0.05 * 0.05 + square(q[0]) + square(q[1]) * (1.0 / 0.64); };
  const Scale core{"core", [=](const V& q) { return sqrt(inner(q)); }};
  scenes.add("bar", {0.4, 0.0}, {0.0, 0.2}, 20.0, {core}, [=](const V& q, const V& p) {
    return kinetic(p) - 0.5 * (q[0] * p[1] - q[1] * p[0]) + 0.5 * log(inner(q));
  });
  // A fast oscillator in special relativity.
  const Scale gamma{
      "gamma", [](const V&, const V& p) { return sqrt(1.0 + square(p[0])); }, {-1.0, -0.5, 0.5, 1.0}};
  scenes.add("relativistic_oscillator", {5.0}, {0.0}, 200.0, {gamma},
             [](const V& q, const V& p) { return sqrt(1.0 + square(p[0])) + 0.5 * square(q[0]); });
  // Stormer's problem in the meridian plane: a charge reflected in the field of a dipole.
  scenes.add("stormer", {1.0, 0.0}, {0.05, 0.15}, 100.0, {{"r", radius.scale, {1.0, 2.0, 3.0}}},
             [](const V& q, const V& p) {
               return kinetic(p) + 0.5 * square(1.0 / q[0] - q[0] * pow(radius_squared(q), -1.5));
             });
  // The Kratzer potential of a molecule.
  scenes.add("kratzer", {6.0}, {0.0}, 270.0, {distance},
             [](const V& q, const V& p) { return kinetic(p) - 2.0 * (1.0 / q[0] - 0.5 / square(q[0])); });
  // The relative motion of two ions in a trap, nearly head-on.
  scenes.add("two_ions", {2.0, 0.1}, {0.0, 0.0}, 60.0, {radius}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * (square(q[0]) + 4.0 * square(q[1])) + 1.0 / sqrt(radius_squared(q));
  });
  // A ball in a box with exponential walls.
  const auto walls = [](const V& q) { return exp(-40.0 * (1.0 + q[0])) + exp(-40.0 * (1.0 - q[0])); };
  const Scale hardness{"hardness", [=](const V& q) { return 1.0 / (1.0 + walls(q)); }, {0.25, 0.5, 1.0}};
  scenes.add("soft_box", {0.0}, {1.0}, 40.0, {hardness},
             [=](const V& q, const V& p) { return kinetic(p) + walls(q); });
  // A pendulum on a cart of the same mass.
  scenes.add("cart", {0.0, 3.0}, {0.0, 0.0}, 60.0, {}, [](const V& q, const V& p) {
    const Recorded c = cos(q[1]);
    return (square(p[0]) - 2.0 * p[0] * p[1] * c + 2.0 * square(p[1])) / (2.0 * (2.0 - c * c)) - c;
  });
  // The nutation of a heavy top (Goldstein 1980, Section 5-7).
  scenes.add("top", {0.6}, {0.0}, 60.0, {sine}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * square((1.2 - cos(q[0])) / sin(q[0])) + cos(q[0]);
  });
  // The Barbanis oscillators.
  scenes.add("barbanis", {0.3, 0.1}, {0.1, 0.2}, 62.0, {}, [](const V& q, const V& p) {
    return kinetic(p) + 0.5 * radius_squared(q) + square(q[0]) * q[1];
  });
}

}  // namespace experiment
