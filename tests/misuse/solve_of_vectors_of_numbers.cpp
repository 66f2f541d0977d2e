// error: A function that is recorded must be generic in its scalar: let it take `const auto& q`
int main() {
  const auto h = [](const avi::Vector<double, 2>& q, const avi::Vector<double, 2>& p) { return q[0] * p[0]; };
  return avi::solve(h, avi::State<2>{.q = {1.0, 0.0}, .p = {0.0, 1.0}}, 1.0, 1e-6).ok() ? 0 : 1;
}
