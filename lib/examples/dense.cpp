#include <avi/solve.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

// A solution that can be called at any time of the run, after it: here for the time at which a pendulum that
// was pushed over the top is at the bottom again, by bisection.

int main() {
  const auto pendulum = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - cos(q[0]); };
  const avi::State<1> start{.q = {0.0}, .p = {2.1}};
  const auto orbit = avi::solve(pendulum, start, 20.0, 1e-10, {.dense = true});
  double low = 0.0, high = 20.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (orbit(middle).q[0] < 2.0 * M_PI ? low : high) = middle;
  }
  std::printf("once around in %.8f\n", high);
  for (const auto& z : orbit(std::vector<double>{5.0, 10.0, 15.0}))
    std::printf("t = %4.1f   q = %.8f\n", z.t, z.q[0]);
}
