#include <avi/solve.hpp>

#include <cstdio>
#include <stdexcept>

// A body that falls into the centre, and one that begins there.

int main() {
  const auto kepler = [](const auto& q, const auto& p) {
    return 0.5 * p.squaredNorm() - 1.0 / sqrt(q.squaredNorm());
  };
  const avi::State<2> at_rest{.q = {1.5, 0.0}, .p = {0.0, 0.0}};
  const auto fall = avi::solve(kepler, at_rest, 10.0, 1e-8);
  std::printf("kept: %s\n", fall.kept() ? "yes" : "no");
  std::printf("%s\n", fall.run.message.c_str());
  const avi::State<2> in_the_centre{.q = {0.0, 0.0}, .p = {1.0, 0.0}};
  try {
    (void)avi::solve(kepler, in_the_centre, 5.0, 1e-8);
  } catch (const std::invalid_argument& error) {
    std::printf("%s\n", error.what());
  }
}
