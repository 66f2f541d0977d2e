// error: An HTVI needs a dimension known at compile time; avi::collocation() takes any.
int main() {
  const avi::NBody<avi::dynamic> bodies(avi::Vector<double, avi::dynamic>::Ones(3));
  avi::State<avi::dynamic> z{.q = avi::Vector<double, avi::dynamic>::Random(6),
                             .p = avi::Vector<double, avi::dynamic>::Zero(6)};
  auto method = avi::type2<1>(avi::poincare(bodies, z));
  return method.step(z, 0.1).evaluations;
}
