#include <avi/core/integrate.hpp>
#include <avi/integrators/stormer_verlet.hpp>
#include <avi/solve.hpp>
#include <avi/version.hpp>

#include <cmath>
#include <cstdio>

/// A program of a stranger's: headers, and a function of the compiled library. Exit status 0 when the energy
/// is kept as order 2 can.
int main() {
  avi::State<1> state{.q = avi::Vector<double, 1>(1.0), .p = avi::Vector<double, 1>(0.0)};
  const auto energy = [](const avi::State<1>& z) { return 0.5 * z.p[0] * z.p[0] - std::cos(z.q[0]); };
  const double before = energy(state);
  auto method = avi::stormer_verlet<1>(
      [](const avi::Vector<double, 1>& q) { return avi::Vector<double, 1>(std::sin(q[0])); });
  const avi::Run run = avi::integrate(method, state, 0.01, {.time = 20.0});
  const double error = std::abs(energy(state) - before);
  std::printf("avi %s, energy off by %.0e\n", avi::version(), error);
  const avi::VectorX memory =
      avi::VectorX::Ones(1000) + avi::VectorX::Ones(1000);  // Eigen's, which the library uses, too
  const avi::State<avi::dynamic> start{.q = memory.head(1), .p = memory.head(1)};
  const auto orbit = avi::solve([](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - cos(q[0]); },
                                start, 5.0, 1e-6);
  return run.outcome == avi::Outcome::ok && error < 1e-4 && orbit.ok() ? 0 : 1;
}
