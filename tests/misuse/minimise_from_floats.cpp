// error: x0 must hold double: the library computes in no other kind of number.
// A start of another precision.
int main() {
  const auto f = [](const auto& x) { return x[0] * x[0]; };
  return avi::minimise(f, Eigen::VectorXf::Ones(1)).ok();
}
