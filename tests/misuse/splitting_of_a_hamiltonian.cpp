// error: A splitting alternates two flows: splitting(Separable(problem), coefficients).
int main() {
  auto method = avi::splitting(avi::Kepler(), avi::compositions::strang);
  avi::State<2> z = avi::Kepler::pericentre(0.5);
  return method.step(z, 0.1).evaluations;
}
