// error: The method has no step(state, h) for this state: is the state of another dimension?
int main() {
  auto method = avi::type2<0>(avi::poincare<2>(avi::Kepler{}, avi::Kepler::pericentre(0.5)), avi::gauss(1));
  avi::State<3> z{.q = {1.0, 0.0, 0.0}, .p = {0.0, 1.0, 0.0}};
  return static_cast<int>(avi::integrate(method, z, 0.1, {.steps = 1}).steps);
}
