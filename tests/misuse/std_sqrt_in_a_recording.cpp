// error: A formula is recorded without values, so its arguments and what is computed from them are no
// numbers: call sqrt(x), pow(x, y) and the like without std:: (after `using std::sqrt;`), and begin sums and
// helper functions with `auto`

int main() {
  const avi::Recording recording([](const auto& x) { return std::sqrt(x[0]); }, 1);
  return recording.inputs();
}
