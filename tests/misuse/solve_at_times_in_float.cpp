// error: After the start comes the end, a number, or a std::vector<double> of times.
int main() {
  const auto h = [](const auto& q, const auto& p) { return 0.5 * (p.squaredNorm() + q.squaredNorm()); };
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  return avi::solve(h, start, std::vector<float>{1.0F, 2.0F}, 1e-6).ok() ? 0 : 1;
}
