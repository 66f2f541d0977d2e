// error: f works in float: the library computes in double alone.
// A function of another precision, without a gradient.
int main() {
  const auto f = [](const Eigen::VectorXf& x) { return x.squaredNorm(); };
  return avi::minimise(f, {1.0, 2.0}).ok();
}
