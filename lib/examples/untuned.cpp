// A Hamiltonian that nobody has tuned: a charge between two fixed nuclei in a magnetic field. solve() is
// told H, the start, the end and how well the state is to be known there; it finds monitor, order and step,
// and says what it found.
#include <avi/avi.hpp>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <stdexcept>

struct TwoNuclei {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::sqrt;
    const double field = 0.3;
    const auto x = p[0] + 0.5 * field * q[1], y = p[1] - 0.5 * field * q[0];
    const auto left = (q[0] + 1.0) * (q[0] + 1.0) + q[1] * q[1];
    const auto right = (q[0] - 1.0) * (q[0] - 1.0) + q[1] * q[1];
    return 0.5 * (x * x + y * y) - 1.0 / sqrt(left) - 0.5 / sqrt(right);
  }
};

struct OneNucleus {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::sqrt;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(q[0] * q[0] + q[1] * q[1]);
  }
};

int main() {
  const avi::State<2> start{.q = {0.0, 1.0}, .p = {0.25, 0.1}};
  std::cout << std::scientific << std::setprecision(0);
  for (const double tolerance : {1e-4, 1e-7, 1e-11}) {
    const auto solution = avi::solve(TwoNuclei(), start, 50.0, tolerance);
    std::cout << "tolerance " << tolerance << ": " << solution.choice.name << ", order "
              << solution.choice.order << ", ended as " << avi::name(solution.run.outcome)
              << " at t = " << std::lround(solution.state.t) << ", tolerance "
              << (solution.kept() ? "kept" : "not kept") << "\n";
  }

  // What does not work is said: a body at rest falls into the nucleus.
  const avi::State<2> falling{.q = {-1.5, 0.0}, .p = {0.0, 0.0}};
  const auto fall = avi::solve(OneNucleus(), falling, 10.0, 1e-8);
  std::cout << "a fall into the centre: "
            << (fall.run.outcome == avi::Outcome::ok && fall.kept() ? "passed" : "noticed") << "\n";
  try {
    (void)avi::solve(OneNucleus(), avi::State<2>{.q = {0.0, 0.0}, .p = {1.0, 0.0}}, 10.0, 1e-8);
  } catch (const std::invalid_argument& error) {
    std::cout << "a start in the centre: " << error.what() << "\n";
  }
}
