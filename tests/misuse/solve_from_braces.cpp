// error: The start is a State, as avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}}.
int main() {
  const auto h = [](const auto& q, const auto& p) { return 0.5 * (p.squaredNorm() + q.squaredNorm()); };
  return avi::solve(h, {.q = {1.0, 0.0}, .p = {0.0, 1.0}}, 1.0, 1e-6).ok() ? 0 : 1;
}
