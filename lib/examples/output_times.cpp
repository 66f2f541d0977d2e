#include <avi/solve.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

// States at times of your own, forwards and then backwards. They are as accurate as the end, and the run
// does not depend on which times they are.

constexpr auto kepler = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(q[0] * q[0] + q[1] * q[1]);
};

int main() {
  const avi::State<2> start{.q = {0.5, 0.0}, .p = {0.0, std::sqrt(3.0)}};  // pericentre, eccentricity 0.5
  const std::vector<double> times{0.0, 1.0, 2.0, 3.0, 100.0};
  const auto orbit = avi::solve(kepler, start, times, 1e-10);
  for (const auto& z : orbit.states)
    std::printf("t = %8.4f   q = (%9.6f, %9.6f)\n", z.t, z.q[0], z.q[1]);

  const auto back = avi::solve(kepler, orbit.state, 0.0, 1e-10);
  std::printf("and back: %s\n", (back.state.q - start.q).norm() < 1e-9 ? "within 1e-9" : "elsewhere");
}
