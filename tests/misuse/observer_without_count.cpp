// error: An observer must be callable as observer(state, k) or as observer(step, k).
int main() {
  auto method = avi::stormer_verlet<2>(&avi::Kepler::potential_gradient<double>);
  auto z = avi::Kepler::pericentre(0.5);
  const auto observer = [](const avi::State<2>&) {};
  return static_cast<int>(avi::integrate(method, z, 0.1, {.steps = 1}, observer).steps);
}
