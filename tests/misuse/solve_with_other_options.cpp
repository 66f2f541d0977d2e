// error: After the tolerance come SolveOptions, such as {.dense = true}, or nothing.
int main() {
  const auto h = [](const auto& q, const auto& p) { return 0.5 * (p.squaredNorm() + q.squaredNorm()); };
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  return avi::solve(h, start, 1.0, 1e-6, "fixed").ok() ? 0 : 1;
}
