// error: The order of htvi<order>() is even and from 2 to 32.
int main() {
  auto z = avi::Kepler::pericentre(0.5);
  return avi::htvi<7>(avi::poincare(avi::Kepler{}, z)).step(z, 0.1).evaluations;
}
