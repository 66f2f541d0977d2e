#include <avi/solve.hpp>

#include <cmath>
#include <cstdio>

// A satellite whose engine works for two of every ten units of time, and pushes along x while it does: H
// switches with time, and steps end where it does.

int main() {
  const auto satellite = [](const auto& q, const auto& t, const auto& p) {
    const auto push = avi::select(cos(2.0 * M_PI * t / 10.0) < std::cos(0.8 * M_PI), 0.01, 0.0);
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - pow(q[0] * q[0] + q[1] * q[1], -0.5) - push * q[0];
  };
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  const auto orbit = avi::solve(satellite, start, {3.9, 4.0, 6.0, 6.1, 100.0}, 1e-10);
  std::printf("   t        x         y      energy\n");
  for (const auto& z : orbit.states)
    std::printf("%5.1f %9.6f %9.6f %9.6f\n", z.t, z.q[0], z.q[1], 0.5 * z.p.squaredNorm() - 1.0 / z.q.norm());
  std::printf("%s\n", orbit.kept() ? "kept" : "not kept");
}
