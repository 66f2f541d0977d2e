// error: resume() is told the number of degrees of freedom: avi::resume<2>(H, file).
int main() {
  const auto h = [](const auto& q, const auto& p) { return 0.5 * (p.squaredNorm() + q.squaredNorm()); };
  return avi::resume(h, "run.txt").ok() ? 0 : 1;
}
