// error: f must be f(x, gradient), which returns the value and fills the gradient, or a formula f(x) for any
// kind of number

// Called with nothing that the library has.
int main() {
  const auto f = [](const char* text) { return *text; };
  return avi::minimise(f, {1.0, 2.0}).ok();
}
