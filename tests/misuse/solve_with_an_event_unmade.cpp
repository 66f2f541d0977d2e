// error: An event is made by when(): {.events = {avi::when(g)}}.
int main() {
  const auto h = [](const auto& q, const auto& p) { return 0.5 * (p.squaredNorm() + q.squaredNorm()); };
  const auto g = [](const auto& q, const auto&) { return q[0]; };
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  return avi::solve(h, start, 1.0, 1e-6, {.events = {g}}).ok() ? 0 : 1;
}
