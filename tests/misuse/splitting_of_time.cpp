// error: A problem to split must have potential_gradient(q): H = T(p) + V(q), and no time in it.
int main() {
  const avi::State<1> start{.q = avi::Vector<double, 1>(0.5), .p = avi::Vector<double, 1>(0.0)};
  const auto problem = avi::time_dependent(
      [](const auto& q, const auto& t, const auto& p) { return p[0] * p[0] + t * q[0] * q[0]; }, start);
  avi::State<2> z = extended(problem, start);
  auto method = avi::splitting(avi::Separable(problem), avi::compositions::strang);
  return method.step(z, 0.1).evaluations;
}
