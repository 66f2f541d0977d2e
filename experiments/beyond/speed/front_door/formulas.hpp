#pragma once
#include "common/problems/double_pendulum.hpp"

#include <array>
#include <cmath>

// The problems of the race, each in two forms: the Hamiltonian as a user of avi::solve() writes it, and y' =
// f(y), y = (q, p), as a user of another library does, with common subexpressions computed only once.

namespace experiment::front_door {

/// Motion in n dimensions in the central potential -strength/r.
template <int n>
struct Kepler {
  static constexpr int dimension = n;
  double strength = 1.0;
  static auto square(const auto& x) {
    auto sum = x[0] * x[0];
    for (int k = 1; k < n; ++k)
      sum += x[k] * x[k];
    return sum;
  }
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    return 0.5 * square(p) - strength / sqrt(square(q));
  }
  template <class S>
  void rates(const S* y, S* f) const {
    const S r2 = square(y), u = -S(strength) / (r2 * std::sqrt(r2));
    for (int k = 0; k < n; ++k)
      f[k] = y[n + k], f[n + k] = u * y[k];
  }
};

/// The problem of Henon and Heiles.
struct HenonHeiles {
  static constexpr int dimension = 2;
  auto operator()(const auto& q, const auto& p) const {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) + q[0] * q[0] * q[1] -
           q[1] * q[1] * q[1] / 3.0;
  }
  template <class S>
  static void rates(const S* y, S* f) {
    f[0] = y[2], f[1] = y[3];
    f[2] = -y[0] - 2 * y[0] * y[1];
    f[3] = -y[1] - y[0] * y[0] + y[1] * y[1];
  }
};

/// A pendulum.
struct Pendulum {
  static constexpr int dimension = 1;
  auto operator()(const auto& q, const auto& p) const {
    using std::cos;
    return 0.5 * p[0] * p[0] - cos(q[0]);
  }
  template <class S>
  static void rates(const S* y, S* f) {
    f[0] = y[1], f[1] = -std::sin(y[0]);
  }
};

/// Bodies of unit mass that attract each other in the plane.
template <int bodies>
struct UnitBodies {
  static constexpr int dimension = 2 * bodies;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    auto energy = 0.5 * (p[0] * p[0] + p[1] * p[1]);
    for (int i = 1; i < bodies; ++i) {
      energy += 0.5 * (p[2 * i] * p[2 * i] + p[2 * i + 1] * p[2 * i + 1]);
      for (int j = 0; j < i; ++j) {
        const auto x = q[2 * i] - q[2 * j], y = q[2 * i + 1] - q[2 * j + 1];
        energy -= 1.0 / sqrt(x * x + y * y);
      }
    }
    return energy;
  }
  template <class S>
  static void rates(const S* y, S* f) {
    for (int k = 0; k < dimension; ++k)
      f[k] = y[dimension + k], f[dimension + k] = 0;
    S* force = f + dimension;
    for (int i = 1; i < bodies; ++i)
      for (int j = 0; j < i; ++j) {
        const S dx = y[2 * i] - y[2 * j], dy = y[2 * i + 1] - y[2 * j + 1], square = dx * dx + dy * dy;
        const S u = 1 / (square * std::sqrt(square));
        force[2 * i] -= u * dx, force[2 * i + 1] -= u * dy;
        force[2 * j] += u * dx, force[2 * j + 1] += u * dy;
      }
  }
};

/// Bodies with masses that attract each other in space.
template <int bodies>
struct Planets {
  static constexpr int dimension = 3 * bodies;
  std::array<double, bodies> mass;
  double gravity;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    const auto kinetic = [&](int i) {
      const auto x = p[3 * i], y = p[3 * i + 1], z = p[3 * i + 2];
      return (x * x + y * y + z * z) / (2.0 * mass[i]);
    };
    auto energy = kinetic(0);
    for (int i = 1; i < bodies; ++i) {
      energy += kinetic(i);
      for (int j = 0; j < i; ++j) {
        const auto x = q[3 * i] - q[3 * j], y = q[3 * i + 1] - q[3 * j + 1], z = q[3 * i + 2] - q[3 * j + 2];
        energy -= gravity * mass[i] * mass[j] / sqrt(x * x + y * y + z * z);
      }
    }
    return energy;
  }
  template <class S>
  void rates(const S* y, S* f) const {
    for (int k = 0; k < dimension; ++k)
      f[k] = y[dimension + k] / mass[k / 3], f[dimension + k] = 0;
    S* force = f + dimension;
    for (int i = 1; i < bodies; ++i)
      for (int j = 0; j < i; ++j) {
        S d[3], square = 0;
        for (int k = 0; k < 3; ++k)
          d[k] = y[3 * i + k] - y[3 * j + k], square += d[k] * d[k];
        const S u = gravity * mass[i] * mass[j] / (square * std::sqrt(square));
        for (int k = 0; k < 3; ++k)
          force[3 * i + k] -= u * d[k], force[3 * j + k] += u * d[k];
      }
  }
};

/// The chain of Fermi, Pasta, Ulam and Tsingou with quartic springs and fixed ends.
template <int masses>
struct Fput {
  static constexpr int dimension = masses;
  double beta = 1.0;
  auto operator()(const auto& q, const auto& p) const {
    const auto spring = [this](const auto& x) { return 0.5 * x * x + 0.25 * beta * (x * x) * (x * x); };
    auto energy = spring(q[0]) + spring(q[masses - 1]) + 0.5 * p[0] * p[0];
    for (int i = 1; i < masses; ++i)
      energy += spring(q[i] - q[i - 1]) + 0.5 * p[i] * p[i];
    return energy;
  }
  template <class S>
  void rates(const S* y, S* f) const {
    S left = y[0] + beta * y[0] * y[0] * y[0];
    for (int i = 0; i < masses; ++i) {
      const S x = (i + 1 < masses ? y[i + 1] : S(0)) - y[i], right = x + beta * x * x * x;
      f[i] = y[masses + i], f[masses + i] = right - left;
      left = right;
    }
  }
};

/// A charge in the field of a magnetic dipole along z: H = |p - A|^2 / 2, A = (-y, x, 0) / r^3.
struct Dipole {
  static constexpr int dimension = 3;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    const auto square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const auto b = 1.0 / (square * sqrt(square));
    const auto vx = p[0] + b * q[1], vy = p[1] - b * q[0];
    return 0.5 * (vx * vx + vy * vy + p[2] * p[2]);
  }
  template <class S>
  static void rates(const S* y, S* f) {
    const S square = y[0] * y[0] + y[1] * y[1] + y[2] * y[2], b = 1 / (square * std::sqrt(square));
    const S vx = y[3] + b * y[1], vy = y[4] - b * y[0], vz = y[5];
    const S c = 3 * b / square * (vx * y[1] - vy * y[0]);  // b' is -3 b q / r^2
    f[0] = vx, f[1] = vy, f[2] = vz;
    f[3] = c * y[0] + b * vy, f[4] = c * y[1] - b * vx, f[5] = c * y[2];
  }
};

// The held-out problems of the race. They were drawn up when the menu of solve() was made. They have been
// looked at since: exponentials, rotating frames and the estimated cost of a candidate were improved after
// Toda's chain, the restricted problem and the galaxy had shown what was slow.

/// A satellite in the equatorial plane of a flattened body, with potential -1/r - c / (3 r^3).
struct Flattened {
  static constexpr int dimension = 2;
  double c = 0.01;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    const auto square = q[0] * q[0] + q[1] * q[1];
    const auto inverse = 1.0 / sqrt(square);
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - inverse - c / 3.0 * inverse / square;
  }
  template <class S>
  void rates(const S* y, S* f) const {
    const S square = y[0] * y[0] + y[1] * y[1], u = (-1 - c / square) / (square * std::sqrt(square));
    f[0] = y[2], f[1] = y[3], f[2] = u * y[0], f[3] = u * y[1];
  }
};

/// The double pendulum, with its equations of motion.
struct DoublePendulum : experiment::DoublePendulum {
  template <class S>
  static void rates(const S* y, S* f) {
    const S s = std::sin(y[0] - y[1]), c = std::cos(y[0] - y[1]), rest = 1 / (1 + s * s);
    const S square = y[2] * y[2] + 2 * y[3] * y[3] - 2 * y[2] * y[3] * c;
    const S torque = rest * s * (y[2] * y[3] - rest * c * square);
    f[0] = rest * (y[2] - c * y[3]), f[1] = rest * (2 * y[3] - c * y[2]);
    f[2] = -torque - 2 * std::sin(y[0]), f[3] = torque - std::sin(y[1]);
  }
};

/// A star in the logarithmic potential of a flattened galaxy with a core (Binney).
struct Galaxy {
  static constexpr int dimension = 2;
  auto operator()(const auto& q, const auto& p) const {
    using std::log;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * log(0.04 + q[0] * q[0] + q[1] * q[1] / 0.81);
  }
  template <class S>
  static void rates(const S* y, S* f) {
    const S u = -1 / (S(0.04) + y[0] * y[0] + y[1] * y[1] / S(0.81));
    f[0] = y[2], f[1] = y[3], f[2] = u * y[0], f[3] = u * y[1] / S(0.81);
  }
};

/// Two atoms of different mass on a line, bound by a Morse potential, each in a shallow well.
struct Morse {
  static constexpr int dimension = 2;
  auto operator()(const auto& q, const auto& p) const {
    using std::exp;
    const auto bond = 1.0 - exp(1.0 - q[1] + q[0]);
    return 0.5 * p[0] * p[0] + 0.25 * p[1] * p[1] + bond * bond + 0.05 * (q[0] * q[0] + q[1] * q[1]);
  }
  template <class S>
  static void rates(const S* y, S* f) {
    const S e = std::exp(1 - y[1] + y[0]), pull = 2 * (1 - e) * e;
    f[0] = y[2], f[1] = y[3] / 2;
    f[2] = pull - y[0] / 10, f[3] = -pull - y[1] / 10;
  }
};

/// A small body in the frame that rotates with two heavy ones, of masses 1 - mu and mu.
struct Restricted {
  static constexpr int dimension = 2;
  double mu = 0.01;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    const auto a = q[0] + mu, b = q[0] - (1.0 - mu), y = q[1] * q[1];
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + q[1] * p[0] - q[0] * p[1] - (1.0 - mu) / sqrt(a * a + y) -
           mu / sqrt(b * b + y);
  }
  template <class S>
  void rates(const S* y, S* f) const {
    const S a = y[0] + mu, b = y[0] - (1 - S(mu)), square = y[1] * y[1], r = a * a + square,
            s = b * b + square;
    const S u = (1 - S(mu)) / (r * std::sqrt(r)), v = mu / (s * std::sqrt(s));
    f[0] = y[2] + y[1], f[1] = y[3] - y[0];
    f[2] = y[3] - u * a - v * b, f[3] = -y[2] - (u + v) * y[1];
  }
};

/// Toda's chain with fixed ends.
template <int masses>
struct Toda {
  static constexpr int dimension = masses;
  auto operator()(const auto& q, const auto& p) const {
    using std::exp;
    auto energy = exp(-q[0]) + exp(q[masses - 1]) + 0.5 * p[0] * p[0];
    for (int i = 1; i < masses; ++i)
      energy += exp(q[i - 1] - q[i]) + 0.5 * p[i] * p[i];
    return energy;
  }
  template <class S>
  static void rates(const S* y, S* f) {
    S left = std::exp(-y[0]);
    for (int i = 0; i < masses; ++i) {
      const S right = std::exp(y[i] - (i + 1 < masses ? y[i + 1] : S(0)));
      f[i] = y[masses + i], f[masses + i] = left - right;
      left = right;
    }
  }
};

/// A relativistic particle in an anisotropic well.
struct Relativistic {
  static constexpr int dimension = 2;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    return sqrt(1.0 + p[0] * p[0] + p[1] * p[1]) + 0.5 * q[0] * q[0] + q[1] * q[1];
  }
  template <class S>
  static void rates(const S* y, S* f) {
    const S inverse = 1 / std::sqrt(1 + y[2] * y[2] + y[3] * y[3]);
    f[0] = inverse * y[2], f[1] = inverse * y[3], f[2] = -y[0], f[3] = -2 * y[1];
  }
};

/// A pendulum with a shaken support; time is its second coordinate, q[1] = t.
struct Shaken {
  static constexpr int dimension = 2;
  auto operator()(const auto& q, const auto& p) const {
    using std::cos;
    return 0.5 * p[0] * p[0] - (1.0 + 0.3 * cos(3.7 * q[1])) * cos(q[0]) + p[1];
  }
  template <class S>
  static void rates(const S* y, S* f) {
    const S c = S(3) / 10, w = S(37) / 10;
    f[0] = y[2], f[1] = 1;
    f[2] = -(1 + c * std::cos(w * y[1])) * std::sin(y[0]);
    f[3] = -c * w * std::sin(w * y[1]) * std::cos(y[0]);
  }
};

}  // namespace experiment::front_door
