#include <avi/solver.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

// One choice of monitor, order and step for many starts, on all cores: which pendulums come back?

int main() {
  const auto pendulum = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - cos(q[0]); };
  std::vector<avi::State<1>> starts;
  for (int i = 0; i <= 8; ++i)
    starts.push_back({.q = {0.0}, .p = {1.6 + 0.1 * i + 0.05}});
  const avi::Solver solver(pendulum, starts[4], 10.0, 1e-8, {.check = false});
  for (const auto& member : solver.ensemble(starts, 10.0)) {
    const auto& z = member.solution.state;
    std::printf("q = %9.6f   %s\n", z.q[0], std::abs(z.q[0]) < M_PI ? "swings" : "turns");
  }
}
