#pragma once
#include "hostile/system.hpp"

#include <cmath>
#include <type_traits>
#include <vector>

/// @file
/// The Hamiltonians, without units, at any scalar. `s.c` are their coefficients in the order in which they
/// are named in the comments.

namespace hostile {

namespace formulas {
using std::cos, std::cosh, std::exp, std::log, std::pow, std::sin, std::sqrt, std::tanh;

template <class S>
S square(const S& x) {
  return x * x;
}

/// The sum of the first `count` squares, at least one.
template <class S>
S squares(const std::vector<S>& x, int first, int count) {
  S sum = x[first] * x[first];
  for (int i = 1; i < count; ++i)
    sum = sum + x[first + i] * x[first + i];
  return sum;
}

/// Sum of p_i^2 / (2 m_i), with m_i = c[first + i].
template <class S>
S kinetic(const System& s, const std::vector<S>& p, int first = 0) {
  S sum = p[0] * p[0] * (0.5 / s.c[first]);
  for (int i = 1; i < s.n; ++i)
    sum = sum + p[i] * p[i] * (0.5 / s.c[first + i]);
  return sum;
}

/// A sum of products of entries of (q, p): k = (length, indices, length, indices, ...), c one factor each.
template <class S>
S polynomial(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  S sum = 0.0;
  std::size_t at = 0;
  for (const double factor : s.c) {
    S product = factor;
    const int length = s.k[at++];
    for (int j = 0; j < length; ++j, ++at)
      product = product * (s.k[at] < s.n ? q[s.k[at]] : p[s.k[at] - s.n]);
    sum = sum + product;
  }
  return sum;
}

/// Masses, weights, couplings to the next one (n each).
template <class S>
S pendula(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  S h = kinetic(s, p);
  for (int i = 0; i < s.n; ++i)
    if (s.c[s.n + i] != 0.0) h = h - s.c[s.n + i] * cos(q[i]);
  for (int i = 0; i + 1 < s.n; ++i)
    if (s.c[2 * s.n + i] != 0.0) h = h - s.c[2 * s.n + i] * cos(q[i] - q[i + 1]);
  return h;
}

/// A charge of unit mass: field B, its growth, stiffness of the trap along x, y (and z).
/// k[0]: 0 plane, B (1 + growth x); 1 dipole; 2 trap in space; 3 wave-like field.
template <class S>
S charge(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const double field = s.c[0], growth = s.c[1];
  if (s.k[0] == 1) {
    const S r2 = squares(q, 0, 3), a = field / (r2 * sqrt(r2));
    return 0.5 * (square(S(p[0] + a * q[1])) + square(S(p[1] - a * q[0])) + p[2] * p[2]) + 0.5 * growth * r2;
  }
  if (s.k[0] == 2) {
    const S x = p[0] + 0.5 * field * q[1], y = p[1] - 0.5 * field * q[0];
    return 0.5 * (x * x + y * y + p[2] * p[2]) +
           0.5 * (s.c[2] * q[0] * q[0] + s.c[3] * q[1] * q[1] + s.c[4] * q[2] * q[2]) +
           growth * square(squares(q, 0, 3));
  }
  const S a =
      s.k[0] == 0 ? S(field * (q[0] + 0.5 * growth * q[0] * q[0])) : S(field * sin(q[0] + growth * q[1]));
  return 0.5 * (p[0] * p[0] + square(S(p[1] - a))) + 0.5 * (s.c[2] * q[0] * q[0] + s.c[3] * q[1] * q[1]);
}

/// Square of the softening, then masses. k = (space): bodies in the plane or in space.
template <class S>
S bodies(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const int d = s.k[0], count = s.n / d;
  S h = squares(p, 0, d) * (0.5 / s.c[1]);
  for (int i = 1; i < count; ++i)
    h = h + squares(p, d * i, d) * (0.5 / s.c[1 + i]);
  for (int i = 1; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      S r2 = square(S(q[d * i] - q[d * j]));
      for (int a = 1; a < d; ++a)
        r2 = r2 + square(S(q[d * i + a] - q[d * j + a]));
      if (s.c[0] > 0.0) r2 = r2 + s.c[0];
      h = h - s.c[1 + i] * s.c[1 + j] / sqrt(r2);
    }
  return h;
}

/// Speed of light, mass, strength. k[0]: 0 spring, 1 softened attraction, 2 quartic, 3 uniform force.
template <class S>
S relativistic(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const double light = s.c[0], mass = s.c[1];
  const S moving = sqrt(mass * mass * light * light * light * light + light * light * squares(p, 0, s.n));
  const S r2 = squares(q, 0, s.n);
  if (s.k[0] == 0) return moving + 0.5 * s.c[2] * r2;
  if (s.k[0] == 1) return moving - s.c[2] / sqrt(r2 + 0.01);
  if (s.k[0] == 2) return moving + 0.25 * s.c[2] * r2 * r2;
  return moving - s.c[2] * q[0];
}

/// Curvature, stiffness. k[0]: 0 conformal, 1 each mass depends on the next coordinate, 2 exponential factor.
template <class S>
S metric(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const S r2 = squares(q, 0, s.n);
  if (s.k[0] == 0) return 0.5 * squares(p, 0, s.n) / (1.0 + s.c[0] * r2) + 0.5 * s.c[1] * r2;
  if (s.k[0] == 2) return 0.5 * squares(p, 0, s.n) * exp(-s.c[0] * r2) + 0.5 * s.c[1] * r2;
  S h = 0.5 * s.c[1] * r2;
  for (int i = 0; i < s.n; ++i)
    h = h + 0.5 * p[i] * p[i] / (1.0 + s.c[0] * square(S(sin(q[(i + 1) % s.n]))));
  return h;
}

/// Geodesics of surfaces. k[0]: 0 sphere in a weight c[0], 1 half-plane, 2 torus of radii c[0], 1, 3 hole of
/// mass c[0] in (t, r, angle).
template <class S>
S surface(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  if (s.k[0] == 0) return 0.5 * (p[0] * p[0] + p[1] * p[1] / square(S(sin(q[0])))) + s.c[0] * cos(q[0]);
  if (s.k[0] == 1) return 0.5 * q[1] * q[1] * (p[0] * p[0] + p[1] * p[1]);
  if (s.k[0] == 2) return 0.5 * (p[0] * p[0] + p[1] * p[1] / square(S(s.c[0] + cos(q[0]))));
  const S f = 1.0 - 2.0 * s.c[0] / q[1];
  return 0.5 * (f * p[1] * p[1] - p[0] * p[0] / f + p[2] * p[2] / (q[1] * q[1]));
}

/// Masses. k[0]: 0 open, 1 closed, 2 with ends held by springs.
template <class S>
S toda(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  S h = kinetic(s, p);
  for (int i = 0; i + 1 < s.n; ++i)
    h = h + exp(q[i] - q[i + 1]);
  if (s.k[0] == 1) h = h + exp(q[s.n - 1] - q[0]);
  if (s.k[0] == 2) h = h + 0.5 * (q[0] * q[0] + q[s.n - 1] * q[s.n - 1]);
  return h;
}

/// Masses, depth, steepness: of each coordinate, and of differences where k[0] is 1.
template <class S>
S morse(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  S h = kinetic(s, p);
  const double depth = s.c[s.n], steep = s.c[s.n + 1];
  h = h + depth * square(S(1.0 - exp(-steep * q[0])));
  for (int i = 1; i < s.n; ++i)
    h = h + depth * square(S(1.0 - exp(-steep * (s.k[0] == 1 ? S(q[i] - q[i - 1]) : q[i]))));
  return h;
}

/// Exponentials: k[0]: 0 exp(c q), 1 cosh(c q), 2 predator and prey, 3 exp of the squares.
template <class S>
S growth(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  if (s.k[0] == 2) return exp(q[0]) - s.c[0] * q[0] + exp(p[0]) - p[0];
  S h = 0.5 * squares(p, 0, s.n);
  if (s.k[0] == 3) return h + exp(s.c[0] * squares(q, 0, s.n));
  for (int i = 0; i < s.n; ++i)
    h = h + (s.k[0] == 0 ? S(exp(s.c[0] * q[i])) : S(cosh(s.c[0] * q[i])));
  return h;
}

/// Masses of atoms in the plane; unit depth and size.
template <class S>
S lennard_jones(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const int count = s.n / 2;
  S h = squares(p, 0, 2) * (0.5 / s.c[0]);
  for (int i = 1; i < count; ++i)
    h = h + squares(p, 2 * i, 2) * (0.5 / s.c[i]);
  for (int i = 1; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      const S r2 = square(S(q[2 * i] - q[2 * j])) + square(S(q[2 * i + 1] - q[2 * j + 1]));
      const S u = 1.0 / (r2 * r2 * r2);
      h = h + 4.0 * (u * u - u);
    }
  return h;
}

/// Masses, strength, exponent (a whole number as k[0]): points on a line that repel the next and, the first
/// one, the origin; with a spring to the origin where c[n + 1] > 0.
template <class S>
S repulsion(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  S h = kinetic(s, p);
  for (int i = 0; i < s.n; ++i) {
    const S d = i == 0 ? q[0] : S(q[i] - q[i - 1]);
    h = h + s.c[s.n] / (s.k[0] == 1 ? d : s.k[0] == 2 ? S(d * d) : S(pow(d, static_cast<double>(s.k[0]))));
  }
  if (s.c[s.n + 1] > 0.0) h = h + 0.5 * s.c[s.n + 1] * squares(q, 0, s.n);
  return h;
}

/// Masses, alpha, beta, stiffness of the site's own spring. k[0]: the last one is held too.
template <class S>
S chain(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  S h = kinetic(s, p);
  const double alpha = s.c[s.n], beta = s.c[s.n + 1], own = s.c[s.n + 2];
  for (int i = 0; i <= s.n - (s.k[0] == 1 ? 0 : 1); ++i) {
    const S d = i == 0 ? q[0] : i == s.n ? S(-q[s.n - 1]) : S(q[i] - q[i - 1]);
    h = h + 0.5 * d * d + (alpha / 3.0) * d * d * d + 0.25 * beta * d * d * d * d;
  }
  if (own != 0.0) h = h + 0.5 * own * squares(q, 0, s.n);
  return h;
}

/// Masses m1, m2, lengths l1, l2, weight g.
template <class S>
S double_pendulum(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const double m1 = s.c[0], m2 = s.c[1], l1 = s.c[2], l2 = s.c[3], g = s.c[4];
  const S between = q[0] - q[1], sine = sin(between);
  const S up = m2 * l2 * l2 * p[0] * p[0] + (m1 + m2) * l1 * l1 * p[1] * p[1] -
               2.0 * m2 * l1 * l2 * p[0] * p[1] * cos(between);
  return up / (2.0 * m2 * l1 * l1 * l2 * l2 * (m1 + m2 * sine * sine)) - (m1 + m2) * g * l1 * cos(q[0]) -
         m2 * g * l2 * cos(q[1]);
}

/// Masses, width, of a well of kind k[0] in the distance from the origin.
template <class S>
S well(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const double width = s.c[s.n];
  const S r2 = squares(q, 0, s.n) * (1.0 / (width * width)), h = kinetic(s, p);
  switch (s.k[0]) {
  case 0:
    return h - exp(-r2);
  case 1:
    return h + r2 * r2;
  case 2:
    return h + r2 * r2 * r2;
  case 3:
    return h + log(1.0 + r2);
  case 4:
    return h - 1.0 / sqrt(1.0 + r2);
  case 5:
    return h + square(S(r2 - 1.0));
  case 6:
    return h + sqrt(1.0 + r2);
  default:
    return h + r2 + tanh(q[0] * (1.0 / width));
  }
}

/// Height, place, width of a wall across the first coordinate of a spring; k[0]: 0 bell, 1 softened 1/r,
/// 2 a step; then stiffness.
template <class S>
S wall(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const S d = (q[0] - s.c[1]) * (1.0 / s.c[2]);
  const S h = 0.5 * squares(p, 0, s.n) + 0.5 * s.c[3] * squares(q, 0, s.n);
  if (s.k[0] == 0) return h + s.c[0] * exp(-d * d);
  if (s.k[0] == 1) return h + s.c[0] * s.c[2] / sqrt(square(S(q[0] - s.c[1])) + s.c[2] * s.c[2]);
  return h + s.c[0] * (0.5 + 0.5 * tanh(d));
}

/// A particle among centres: stiffness of the box, then for each centre height, width, place.
/// k = (kind, count): 0 bells, 1 softened charges, 2 screened charges.
template <class S>
S scatterers(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  S h = 0.5 * squares(p, 0, s.n);
  if (s.c[0] > 0.0) h = h + 0.25 * s.c[0] * square(squares(q, 0, s.n));
  for (int i = 0; i < s.k[1]; ++i) {
    const double* centre = s.c.data() + 1 + i * (2 + s.n);
    S r2 = square(S(q[0] - centre[2]));
    for (int a = 1; a < s.n; ++a)
      r2 = r2 + square(S(q[a] - centre[2 + a]));
    if (s.k[0] == 0) {
      h = h + centre[0] * exp(r2 * (-1.0 / (centre[1] * centre[1])));
    } else {
      const S r = sqrt(r2 + centre[1] * centre[1]);
      h = h + (s.k[0] == 1 ? S(centre[0] / r) : S(centre[0] * exp(-r) / r));
    }
  }
  return h;
}

/// Strength, frequency; the last coordinate is the time. k[0]: 0 pendulum, 1 Duffing, 2 parametric spring.
template <class S>
S driven(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const S force = s.c[0] * cos(s.c[1] * q[1]), h = 0.5 * p[0] * p[0] + p[1];
  if (s.k[0] == 0) return h - cos(q[0]) - force * q[0];
  if (s.k[0] == 1) return h - 0.5 * q[0] * q[0] + 0.25 * square(square(q[0])) - force * q[0];
  return h + 0.5 * (1.0 + force) * q[0] * q[0];
}

/// Mass ratio: a particle in the frame that turns with two bodies.
template <class S>
S three_body(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const double mu = s.c[0];
  S rest = square(q[1]);
  if (s.n == 3) rest = rest + square(q[2]);
  return 0.5 * squares(p, 0, s.n) - q[0] * p[1] + q[1] * p[0] -
         (1.0 - mu) / sqrt(square(S(q[0] + mu)) + rest) - mu / sqrt(square(S(q[0] - (1.0 - mu))) + rest);
}

/// Strength of a perturbation. k[0]: 0 none, 1 1/r^3, 2 unequal masses, 3 1/r^2.
template <class S>
S kepler(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const S r2 = squares(q, 0, s.n), r = sqrt(r2), h = 0.5 * squares(p, 0, s.n) - 1.0 / r;
  if (s.k[0] == 1) return h - s.c[0] / (r2 * r);
  if (s.k[0] == 2) return h + 0.5 * s.c[0] * p[0] * p[0];
  if (s.k[0] == 3) return h - s.c[0] / r2;
  return h;
}

/// Formulas that are no sum of kinetic and potential energy, by k[0].
template <class S>
S odd(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const double a = s.c[0];
  switch (s.k[0]) {
  case 0:
    return -cos(p[0]) - a * cos(q[0]);
  case 1:
    return 0.25 * (square(square(p[0])) + a * square(square(q[0])));
  case 2:
    return 0.5 * log(1.0 + p[0] * p[0]) + 0.5 * a * q[0] * q[0];
  case 3:
    return -1.0 * sqrt((1.0 + a) - a * tanh(0.5 * q[0] * q[0]) - p[0] * p[0]);
  case 4:
    return sqrt(1.0 + p[0] * p[0]) * sqrt(1.0 + a * q[0] * q[0]);
  case 5:
    return a * q[0] * p[0] + 0.01 * q[0] * q[0] * p[0] * p[0];
  case 6:
    return 0.5 * square(S(q[0] * q[0] + p[0] * p[0])) + a * q[0] * p[0];
  default:
    return square(S(0.5 * (p[0] * p[0] + q[0] * q[0]))) + a * p[0] * p[1] + 0.5 * (p[1] * p[1] + q[1] * q[1]);
  }
}

/// Moments of inertia of the figure about its cross axis and its own axis, weight: a heavy top in Euler's
/// angles.
template <class S>
S top(const System& s, const std::vector<S>& q, const std::vector<S>& p) {
  const S sine = sin(q[0]), cosine = cos(q[0]);
  return 0.5 * p[0] * p[0] / s.c[0] + square(S(p[1] - p[2] * cosine)) / (2.0 * s.c[0] * sine * sine) +
         0.5 * p[2] * p[2] / s.c[1] + s.c[2] * cosine;
}
}  // namespace formulas

template <class Q>
auto System::operator()(const Q& q_given, const Q& p_given) const {
  using S = std::decay_t<decltype(q_given[0])>;
  std::vector<S> x(n), y(n);
  for (int i = 0; i < n; ++i)
    x[i] = unit[i] == 1.0 ? q_given[i] : S(q_given[i] * (1.0 / unit[i])),
    y[i] = unit[i] == action ? p_given[i] : S(p_given[i] * (unit[i] / action));
#define POINTER(name) formulas::name<S>,
  constexpr S (*all[])(const System&, const std::vector<S>&,
                       const std::vector<S>&) = {HOSTILE_FORMULAS(POINTER)};
#undef POINTER
  const S value = all[static_cast<std::size_t>(formula)](*this, x, y);
  return energy == 1.0 ? value : S(value * energy);
}

}  // namespace hostile
