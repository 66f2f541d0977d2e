// error: The largest order of collocation is from 2 to 32.
int main() {
  auto z = avi::Kepler::pericentre(0.5);
  return avi::collocation<34>(avi::poincare(avi::Kepler{}, z), 34).step(z, 0.1).evaluations;
}
