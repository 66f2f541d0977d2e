#include <avi/optim/minimise.hpp>

#include <cstdio>

int main() {
  const auto rosenbrock = [](const auto& x) {
    const auto a = 1.0 - x[0], b = x[1] - x[0] * x[0];
    return a * a + 100.0 * b * b;
  };
  const auto run = avi::minimise(rosenbrock, {-1.2, 1.0}, {.relative = 1e-10});
  std::printf("%s, minimum at (%.6f, %.6f)\n", run.ok() ? "converged" : run.message.c_str(), run.last.x[0],
              run.last.x[1]);
}
