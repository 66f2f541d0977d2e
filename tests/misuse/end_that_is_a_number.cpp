// error: The end of integrate(method, state, h, until) is an Until, such as {.time = 10.0} or {.steps = 100};
int main() {
  auto z = avi::Kepler::pericentre(0.5);
  auto method = avi::splitting(avi::LogHamiltonian(avi::Kepler{}, z), avi::compositions::kahan_li8);
  return static_cast<int>(avi::integrate(method, z, 0.1, 10.0).steps);
}
