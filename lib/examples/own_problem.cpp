#include <avi/diagnostics/order.hpp>
#include <avi/diagnostics/symplecticity.hpp>
#include <avi/htvi/htvi.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

// A Hamiltonian of one's own, and the two questions to ask of a method on it: is its order what it should be,
// and is it symplectic?

//! [hamiltonian]
struct Quartic {  // two coupled oscillators in a quartic well
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const auto square = q.squaredNorm();
    return 0.5 * p.squaredNorm() + 0.25 * square * square + q[0] * q[1];
  }
};
//! [hamiltonian]

const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 0.5}};

//! [run]
/// The largest energy error over T = 100, or NaN for a run that fails.
template <class Method>
double energy_error(Method method, double h) {
  const Quartic hamiltonian;
  const double energy = hamiltonian(start.q, start.p);
  double worst = 0.0;
  avi::State<2> z = start;
  const avi::Run run = avi::integrate(method, z, h, {.time = 100.0}, [&](const avi::State<2>& now, long) {
    worst = std::max(worst, std::abs(hamiltonian(now.q, now.p) - energy));
  });
  if (run.outcome != avi::Outcome::ok) std::puts(run.message.c_str());
  return run.outcome == avi::Outcome::ok ? worst : std::nan("");
}
//! [run]

int main() {
  const auto problem = avi::poincare<2>(Quartic{}, start);
  std::printf("rule     h = 0.28  0.20     0.14     order   defect of a step\n");
  for (int nodes : {3, 6}) {
    const auto method = avi::type2<5>(problem, avi::gauss(nodes));
    const double h[] = {0.28, 0.2, 0.14};
    double error[3];
    std::transform(h, h + 3, error, [&](double step) { return energy_error(method, step); });
    std::printf("gauss(%d) %.0e     %.0e    %.0e    %4.1f     %s\n", nodes, error[0], error[1], error[2],
                avi::fit_order(h, error).order,
                avi::symplecticity_defect(method, start, 0.2) < 1e-10 ? "below 1e-10" : "too large");
  }
}
