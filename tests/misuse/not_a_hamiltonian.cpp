// error: The Hamiltonian must be callable as H(q, p) with vectors of n entries.
struct Potential {
  template <class Q>
  auto operator()(const Q& q) const {
    return 0.5 * (q[0] * q[0]);
  }
};

int main() {
  const avi::Poincare<1, Potential> problem(Potential{}, avi::Unit{}, 0.0);
  return static_cast<int>(problem.size());
}
