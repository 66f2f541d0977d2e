// error: The Hamiltonian must be callable as H(q, t, p) with vectors of n entries.
int main() {
  const auto problem = avi::time_dependent(avi::Kepler{}, avi::Kepler::pericentre(0.5));
  return static_cast<int>(problem.size());
}
