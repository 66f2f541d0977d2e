#include <avi/solve.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

// A pendulum that is pushed periodically: H(q, t, p) depends on time, and solve() takes it like any other.

constexpr double amplitude = 0.3, omega = 2.0 / 3.0;

int main() {
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] - cos(q[0]) - amplitude * q[0] * cos(omega * t);
  };
  const avi::State<1> start{.q = {0.5}, .p = {0.0}};
  std::vector<double> periods;
  for (int k = 1; k <= 6; ++k)
    periods.push_back(k * 2.0 * M_PI / omega);
  const auto orbit = avi::solve(driven, start, periods, 1e-10);
  std::printf("period    angle    momentum\n");
  for (std::size_t k = 0; k < periods.size(); ++k)
    std::printf("%4zu   %9.4f   %8.4f\n", k + 1, orbit.states[k].q[0], orbit.states[k].p[0]);
  std::printf("%s\n", orbit.kept() ? "kept" : "not kept");
}
