// error: The monitor of Euler-B must be callable as g(q): its equation is solved in closed form.
int main() {
  const auto monitor = [](const auto& q, const auto& p) { return q[0] * p[0]; };
  auto z = avi::Kepler::pericentre(0.5);
  return static_cast<int>(avi::euler_b(avi::Kepler{}, z, monitor).step(z, 0.1).evaluations);
}
