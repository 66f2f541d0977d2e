#include <avi/solve.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const auto kepler = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - pow(q[0] * q[0] + q[1] * q[1], -0.5);
  };
  const avi::State<2> start{.q = {0.1, 0.0}, .p = {0.0, std::sqrt(19.0)}};  // pericentre, e = 0.9
  const auto orbit = avi::solve(kepler, start, 20.0 * M_PI, 1e-10);         // ten periods
  if (!orbit.kept()) return std::puts(orbit.report().c_str()), 1;
  std::printf("%ld steps, back at the start to %.0e\n", orbit.run.steps, (orbit.state.q - start.q).norm());
}
