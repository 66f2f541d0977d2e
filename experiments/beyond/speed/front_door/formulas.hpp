#pragma once
#include <array>
#include <cmath>

// The problems of the race, each in two forms: the Hamiltonian as a user of avi::solve() writes it, and y' =
// f(y), y = (q, p), as a user of another library does, with common subexpressions computed only once.

namespace experiment::front_door {

/// Motion in the plane in the central potential -1/r.
struct Kepler {
  static constexpr int dimension = 2;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(q[0] * q[0] + q[1] * q[1]);
  }
  template <class S>
  static void rates(const S* y, S* f) {
    const S square = y[0] * y[0] + y[1] * y[1], u = -1 / (square * std::sqrt(square));
    f[0] = y[2], f[1] = y[3], f[2] = u * y[0], f[3] = u * y[1];
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

}  // namespace experiment::front_door
