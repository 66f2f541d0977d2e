// error: A formula is recorded without values, so its arguments and what is computed from them are no
// numbers: call sqrt(x), pow(x, y) and the like without std:: (after `using std::sqrt;`), and begin sums and
// helper functions with `auto`

int main() {
  const avi::Recording recording(
      [](const auto& x) {
        double sum = 0.0;
        for (int i = 0; i < x.size(); ++i)
          sum += x[i] * x[i];
        return sum;
      },
      2);
  return recording.inputs();
}
