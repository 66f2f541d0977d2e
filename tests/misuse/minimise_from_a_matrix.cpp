// error: x0 must be a vector of Eigen, numbers in braces, or an array of double.
// A start that is no vector.
int main() {
  const auto f = [](const auto& x) { return x[0] * x[0]; };
  return avi::minimise(f, Eigen::Matrix2d::Identity()).ok();
}
