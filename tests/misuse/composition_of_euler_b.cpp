// error: The base of a composition must declare that it is symmetric: of another one the order stays what it
// is.

int main() {
  avi::State<2> z = avi::Kepler::pericentre(0.5);
  avi::Composition method(avi::euler_b(avi::Kepler(), z), avi::compositions::yoshida4);
  return method.step(z, 0.1).evaluations;
}
