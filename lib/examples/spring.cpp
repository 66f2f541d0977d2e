#include <avi/solve.hpp>

#include <cstdio>

// A weight on a spring, and the same weight on a rope, which pulls only where it is taut.

int main() {
  const auto spring = [stiffness = 10.0](const auto& q, const auto& p) {
    const auto stretch = sqrt(q[0] * q[0] + q[1] * q[1]) - 1.0;
    return 0.5 * p.squaredNorm() + 0.5 * stiffness * stretch * stretch + q[1];
  };
  const auto rope = [stiffness = 10.0](const auto& q, const auto& p) {
    using avi::select;
    const auto stretch = sqrt(q[0] * q[0] + q[1] * q[1]) - 1.0;
    return 0.5 * p.squaredNorm() + 0.5 * stiffness * select(stretch > 0.0, stretch * stretch, 0.0 * stretch) +
           q[1];
  };
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 0.0}};
  const auto print = [](const char* name, const auto& fall) {
    if (!fall.kept()) std::printf("%s\n", fall.report().c_str());
    std::printf("%s: at (%.4f, %.4f) after t = %g\n", name, fall.state.q[0], fall.state.q[1], fall.state.t);
  };
  print("spring", avi::solve(spring, start, 10.0, 1e-8));
  print("rope", avi::solve(rope, start, 10.0, 1e-5));
}
