// A stranger's program in one file, compiled without any option of the package: no warning.
#include <avi/avi.hpp>

#include <cmath>

int main() {
  const auto f = [](const auto& x) {
    auto sum = x[0] * x[0];
    for (int i = 1; i < x.size(); ++i)
      sum += x[i] * x[i] + exp(x[i]);
    return sum;
  };
  const bool lowest = avi::minimise(f, Eigen::VectorXd::Ones(5)).outcome == avi::Outcome::ok;
  const auto h = [](const auto& q, const auto& p) {
    using std::sqrt;
    return 0.5 * p.squaredNorm() - 1.0 / sqrt(q.squaredNorm());
  };
  avi::State<2> a{.q = {1.0, 0.0}, .p = {0.0, 1.0}}, b = a;
  auto gauss = avi::collocation(avi::poincare<2>(h, a), 8);
  auto taylor = avi::htvi<8>(avi::poincare<2>(h, b));
  const bool one = avi::integrate(gauss, a, 0.1, {.time = 3.0}).outcome == avi::Outcome::ok;
  const bool other = avi::integrate(taylor, b, 0.1, {.time = 3.0}).outcome == avi::Outcome::ok;
  return lowest && one && other ? 0 : 1;
}
