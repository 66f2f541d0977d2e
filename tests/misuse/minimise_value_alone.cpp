// error: f gives a value alone: have it fill a gradient, too, f(x, gradient), or write it for any kind of
// number

// A function for one kind of number and without a gradient.
int main() {
  const auto f = [](const avi::VectorX& x) { return x.squaredNorm(); };
  return avi::minimise(f, {1.0, 2.0}).ok();
}
