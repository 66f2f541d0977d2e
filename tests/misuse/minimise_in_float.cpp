// error: f works in float: the library computes in double alone.
// An objective of another precision.
int main() {
  const auto f = [](const Eigen::VectorXf& x, Eigen::VectorXf& g) {
    g = x;
    return 0.5F * x.squaredNorm();
  };
  return avi::minimise(f, {1.0, 2.0}).ok();
}
