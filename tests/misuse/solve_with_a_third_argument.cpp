// error: This function takes a third argument: H(q, t, p) becomes a function of (q, p) by
#include <avi/solve.hpp>

int main() {
  const auto h = [](const auto& q, const auto& t, const auto& p) { return q[0] * p[0] * t; };
  return avi::solve(h, avi::State<2>{.q = {1.0, 0.0}, .p = {0.0, 1.0}}, 1.0, 1e-6).ok() ? 0 : 1;
}
