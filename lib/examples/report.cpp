#include <avi/solve.hpp>

#include <cmath>
#include <cstdio>

// What solve() says of an orbit: how good it is, what was chosen, and what was tried before.

int main() {
  const auto kepler = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - pow(q[0] * q[0] + q[1] * q[1], -0.5);
  };
  const avi::State<2> start{.q = {0.1, 0.0}, .p = {0.0, std::sqrt(19.0)}};
  const auto orbit = avi::solve(kepler, start, 20.0 * M_PI, 1e-6);
  std::printf("%s", orbit.report().c_str());
}
