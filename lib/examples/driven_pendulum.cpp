#include <avi/core/integrate_to.hpp>
#include <avi/htvi/htvi.hpp>
#include <avi/transform/time_dependent.hpp>

#include <cmath>
#include <cstdio>

// A pendulum pushed periodically, H(q, t, p) = p^2 / 2 - cos q - A q cos(omega t): the Hamiltonian depends on
// time, so time and its momentum p^t become coordinates (end of Section 3.1 of the paper), and p^t + H stays
// zero as the energy of an autonomous problem stays constant.

constexpr double amplitude = 0.3, omega = 2.0 / 3.0;

struct DrivenPendulum {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S& t, const P& p) const {
    using std::cos;
    return 0.5 * (p[0] * p[0]) - cos(q[0]) - amplitude * (q[0] * cos(omega * t));
  }
};

int main() {
  const DrivenPendulum hamiltonian;
  const avi::State<1> start{.q = avi::Vector<double, 1>(0.5), .p = avi::Vector<double, 1>(0.0)};
  const auto problem = avi::time_dependent(hamiltonian, start);
  auto method = avi::htvi<6>(problem);

  avi::State<2> bar = avi::extended(problem, start);  // (q, t), (p, p^t)

  const double period = 2.0 * M_PI / omega;
  std::printf("period    angle    momentum   energy     |H + p^t|\n");
  for (int k = 1; k <= 6; ++k) {
    const avi::Run run = avi::integrate_to(method, bar, 0.1, k * period);
    if (run.outcome != avi::Outcome::ok) {
      std::printf("%s\n", run.message.c_str());
      return 1;
    }
    const avi::State<1> z = avi::reduced(bar);
    const double energy = hamiltonian(z.q, z.t, z.p);
    std::printf("%4d   %9.4f   %8.4f   %7.4f   %s\n", k, z.q[0], z.p[0], energy,
                std::abs(energy + bar.p[1]) < 1e-9 ? "below 1e-9" : "too large");
  }
}
