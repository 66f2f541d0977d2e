// error: H comes first, then the start: solve(H, start, t_end, tolerance).
int main() {
  const auto h = [](const auto& q, const auto& p) { return 0.5 * (p.squaredNorm() + q.squaredNorm()); };
  return avi::solve(avi::State<2>{.q = {1.0, 0.0}, .p = {0.0, 1.0}}, h, 1.0, 1e-6).ok() ? 0 : 1;
}
