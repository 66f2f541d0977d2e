// error: The monitor must be callable as g(q) or g(q, p) with vectors of n entries.
int main() {
  const auto monitor = [](const auto& q, const auto& t, const auto&) { return q[0] * t; };
  const auto problem = avi::poincare(avi::Kepler{}, avi::Kepler::pericentre(0.5), monitor);
  return static_cast<int>(problem.size());
}
