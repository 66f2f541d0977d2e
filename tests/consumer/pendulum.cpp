#include <avi/core/integrate.hpp>
#include <avi/htvi/htvi.hpp>
#include <avi/transform/poincare.hpp>

#include <cmath>

/// A Hamiltonian of one's own, nothing else; exit status 0 when its energy is kept as order 2 can.
struct Pendulum {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::cos;
    return 0.5 * p[0] * p[0] - cos(q[0]);
  }
};

int main() {
  const Pendulum pendulum;
  avi::State<1> state{.q = avi::Vector<double, 1>(1.0), .p = avi::Vector<double, 1>(0.0)};
  const double energy = pendulum(state.q, state.p);
  auto method = avi::type2<1>(avi::poincare<1>(pendulum, state, avi::Unit{}), avi::simpson());
  const avi::Run run = avi::integrate(method, state, 0.01, {.time = 20.0});
  const double error = std::abs(pendulum(state.q, state.p) - energy);
  return run.outcome == avi::Outcome::ok && error < 1e-4 ? 0 : 1;
}
