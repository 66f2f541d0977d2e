// error: Euler-B needs a dimension known at compile time.
int main() {
  const avi::NBody<avi::dynamic> bodies(avi::Vector<double, avi::dynamic>::Ones(3));
  avi::State<avi::dynamic> z{.q = avi::Vector<double, avi::dynamic>::Random(6),
                             .p = avi::Vector<double, avi::dynamic>::Zero(6)};
  return avi::euler_b(bodies, z).step(z, 0.1).evaluations;
}
