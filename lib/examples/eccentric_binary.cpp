#include <avi/core/integrate_to.hpp>
#include <avi/htvi/htvi.hpp>
#include <avi/problems/n_body.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

// Two stars on an orbit of eccentricity 0.95 and a light third body far out, all attracting each other. The
// binary needs short steps at each of its close passages; a monitor of one's own provides them.

/// g = (sum over pairs of 1 / r^3)^(-1/2), about the smallest distance to the power 3/2 (the time of free
/// fall from there), but smooth: the smallest distance itself jumps from pair to pair, and a Taylor method
/// needs derivatives. It is called with vectors of any scalar, like the Hamiltonian; it has to be positive.
struct ClosestPair {
  template <class Q>
  auto operator()(const Q& q) const {
    const auto close = [&](int i, int j) { return pow(avi::NBody<3>::distance_squared(q, i, j), -1.5); };
    return pow(close(0, 1) + close(0, 2) + close(1, 2), -0.5);
  }
};

template <class Monitor>
void follow(const char* name, double h, const Monitor& monitor) {
  const avi::NBody<3> bodies(avi::Vector<double, 3>(0.5, 0.5, 0.01));
  // Binary at its apocentre 1.95 (semi-major axis 1, period 2 pi), third body on a circle of radius 8.
  const double v = std::sqrt(0.05 / 1.95), w = std::sqrt(1.0 / 8.0);
  avi::State<6> z;
  z.q << 0.975, 0.0, -0.975, 0.0, 0.0, 8.0;
  z.p << 0.0, 0.25 * v, 0.0, -0.25 * v, -0.01 * w, 0.0;
  const double energy = bodies(z.q, z.p);

  auto method = avi::htvi<8>(avi::poincare<6>(bodies, z, monitor));
  double shortest = 1e9, worst = 0.0, t = 0.0;
  const avi::Run run = avi::integrate(method, z, h, {.time = 40.0 * M_PI}, [&](const auto& now, long) {
    shortest = std::min(shortest, now.t - t);
    t = now.t;
    worst = std::max(worst, std::abs(bodies(now.q, now.p) - energy));
  });
  if (run.outcome == avi::Outcome::ok)
    std::printf("%s: %ld steps to t = %.1f, shortest %.4f, energy error %.0e\n", name, run.steps, z.t,
                shortest, worst);
  else  // where in it moves with the last bits
    std::printf("%s: the run failed in orbit %.0f\n", name, 1.0 + std::floor(z.t / (2.0 * M_PI)));
}

int main() {
  follow("closest pair", 0.2, ClosestPair{});
  follow("fixed steps", 0.025, avi::Unit{});
}
