// error: The monitor must be callable as g(q) or g(q, p) with vectors of n entries.
int main() {
  const avi::Poincare<2, avi::Kepler, double> problem(avi::Kepler{}, 0.1, 0.5);
  return static_cast<int>(problem.size());
}
