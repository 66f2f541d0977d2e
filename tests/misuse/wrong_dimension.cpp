// error: The Hamiltonian is of another dimension than the state.
int main() {
  const avi::State<3> z{.q = {1.0, 0.0, 0.0}, .p = {0.0, 1.0, 0.0}};
  return static_cast<int>(avi::poincare<3>(avi::Kepler{}, z).size());
}
