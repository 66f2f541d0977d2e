// error: Dense output needs a method with a polynomial; at_times() serves every method.
int main() {
  const auto method =
      avi::stormer_verlet<2>([](const auto& q) { return avi::Kepler::potential_gradient(q); });
  const auto z = avi::Kepler::pericentre(0.5);
  return static_cast<int>(avi::dense_output(method, z, z, 0.0).t);
}
