// error: integrate() takes a method, such as collocation(poincare(H, start), 8), and runs it; solve(H, start,
int main() {
  const auto H = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0] + q[0] * q[0]); };
  avi::State<1> z{.q = {1.0}, .p = {0.0}};
  return static_cast<int>(avi::integrate(H, z, 10.0, 1e-8).steps);
}
