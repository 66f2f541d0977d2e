#include <avi/optim/minimise.hpp>
#include <avi/solve.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

/// @file
/// Orbits and minima whose digits digits_test.py compares with those that Python gets: one line of numbers in
/// hexadecimal each. With a number of repetitions, the least seconds of a call that measure/python_door.py
/// compares with Python's.

namespace {

template <class Numbers>
void print(const char* name, const Numbers& x) {
  std::printf("%s", name);
  for (const double each : x)
    std::printf(" %a", each);
  std::puts("");
}

template <class H, int n>
void orbit(const char* name, const H& hamiltonian, const avi::State<n>& start, double t, double tolerance) {
  const auto found = avi::solve(hamiltonian, start, t, tolerance);
  print(name, found.state.q);
  print(name, found.state.p);
  print(name, std::vector{found.state.t, found.state_error, found.energy_error});
}

/// Seconds of 100 periods of a Kepler orbit of eccentricity 0.9.
double seconds() {
  const auto begun = std::chrono::steady_clock::now();
  const auto kepler = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - pow(q[0] * q[0] + q[1] * q[1], -0.5);
  };
  const auto found =
      avi::solve(kepler, avi::State<2>{.q = {0.1, 0.0}, .p = {0.0, std::sqrt(19.0)}}, 200.0 * M_PI, 1e-9);
  return found.ok() ? std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() : 0.0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    double least = seconds();
    for (int i = std::atoi(argv[1]); i > 0; --i)
      least = std::min(least, seconds());
    std::printf("%.9f\n", least);
    return 0;
  }
  orbit(
      "kepler",
      [](const auto& q, const auto& p) {
        return 0.5 * (p[0] * p[0] + p[1] * p[1]) - pow(q[0] * q[0] + q[1] * q[1], -0.5);
      },
      avi::State<2>{.q = {0.1, 0.0}, .p = {0.0, std::sqrt(19.0)}}, 62.0, 1e-10);
  orbit(
      "henon_heiles",
      [](const auto& q, const auto& p) {
        auto squares = p[0] * p[0];
        for (const auto& z : {p[1], q[0], q[1]})
          squares += z * z;
        auto energy = 0.5 * squares;
        energy += q[0] * q[0] * q[1];
        return energy - pow(q[1], 3) / 3.0;
      },
      avi::State<2>{.q = {0.0, 0.1}, .p = {0.5, 0.0}}, 30.0, 1e-8);
  orbit(
      "pendulum", [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - cos(q[0]); },
      avi::State<1>{.q = {1.0}, .p = {0.0}}, 20.0, 1e-9);
  avi::VectorX x0(4);
  x0 << -1.0, 1.0, -1.0, 1.0;
  const auto run = avi::minimise(
      [](const auto& x) {
        auto sum = 100.0 * (x[1] - x[0] * x[0]) * (x[1] - x[0] * x[0]) + (1.0 - x[0]) * (1.0 - x[0]);
        for (int i = 1; i < 3; ++i)
          sum += 100.0 * (x[i + 1] - x[i] * x[i]) * (x[i + 1] - x[i] * x[i]) + (1.0 - x[i]) * (1.0 - x[i]);
        return sum;
      },
      x0);
  print("rosenbrock", run.last.x);
  print("rosenbrock", std::vector{run.last.value, static_cast<double>(run.gradient_evaluations)});
}
