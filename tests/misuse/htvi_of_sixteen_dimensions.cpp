// error: An HTVI carries 2n + 1 partials at a time: n is at most 15; avi::collocation() takes any.
struct Springs {
  template <class V>
  auto operator()(const V& q, const V& p) const {
    return 0.5 * (dot(p, p) + dot(q, q));
  }
};

int main() {
  avi::State<16> z{.q = avi::Vector<double, 16>::Zero(), .p = avi::Vector<double, 16>::Ones()};
  auto method = avi::type2<1>(avi::poincare(Springs{}, z));
  return method.step(z, 0.1).evaluations;
}
