#include <avi/solve.hpp>

#include <array>
#include <cmath>
#include <cstdio>

// Sun, Jupiter, Saturn and a comet like Halley's for 1000 years, the comet as heavy as a planet and without a
// mass. Units: astronomical units, solar masses, and years over 2 pi, in which the constant of gravity
// is 1.

int main() {
  for (const double comet : {1e-6, avi::massless}) {
    const std::array mass{1.0, 9.5e-4, 2.9e-4, comet};
    const auto bodies = [&](const auto& q, const auto& p) {
      auto energy = 0.0 * q[0];
      for (int i = 0; i < 4; ++i) {
        energy += (p[2 * i] * p[2 * i] + p[2 * i + 1] * p[2 * i + 1]) / (2.0 * mass[i]);
        for (int k = 0; k < i; ++k)
          energy -= mass[i] * mass[k] / hypot(q[2 * i] - q[2 * k], q[2 * i + 1] - q[2 * k + 1]);
      }
      return energy;
    };
    avi::State<8> start;  // circles, and a perihelion
    start.q << 0.0, 0.0, 5.2, 0.0, -9.5, 0.0, 0.587, 0.0;
    const double v[]{0.0, std::sqrt(1.0 / 5.2), -std::sqrt(1.0 / 9.5), std::sqrt(1.967 / 0.587)};
    for (int i = 0; i < 4; ++i)
      start.p[2 * i] = 0.0, start.p[2 * i + 1] = mass[i] * v[i];

    const auto orbit = avi::solve(bodies, start, 2000.0 * M_PI, 1e-8);
    if (!orbit.kept()) return std::puts(orbit.report().c_str()), 1;
    const auto& q = orbit.state.q;
    std::printf("a comet of %.0e is %.5f AU from the Sun\n", comet, std::hypot(q[6] - q[0], q[7] - q[1]));
  }
}
