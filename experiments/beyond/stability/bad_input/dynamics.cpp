#include "beyond/stability/bad_input/tries.hpp"

#include "avi/core/integrate.hpp"
#include "avi/htvi/quadrature.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"

#include <vector>

namespace experiment {

using namespace avi;

namespace {

void try_loop(Tries& tries) {
  tries.part = "integrate";
  const auto start = Kepler::pericentre(0.5);
  const auto run = [&](double h, Until until) {
    auto method = stormer_verlet<2>([](const auto& q) { return Kepler::potential_gradient(q); });
    auto z = start;
    return integrate(method, z, h, until);
  };
  tries.all("h", std::vector{0.0, nan, inf, -inf}, [&](double h) { (void)run(h, {.time = 1.0}); });
  tries.one("h away from a time ahead", -0.1, [&] { (void)run(-0.1, {.time = 1.0}); });
  tries.one("h away from a time behind", 0.1, [&] { (void)run(0.1, {.time = -1.0}); });
  tries.one("end", nan, [&] { (void)run(0.1, {.time = nan}); });
  tries.one("no end", "not set", [&] { (void)run(0.1, {}); });
  tries.one("steps", -1, [&] { (void)run(0.1, {.steps = -1}); });
}

void try_monitors(Tries& tries) {
  tries.part = "monitors";
  tries.all("a", std::vector{-1.0, nan, inf}, [](double a) { bounded(Gamma{}, a, 2.0); });
  tries.all("b", std::vector{0.0, 0.5, nan, inf}, [](double b) { bounded(Gamma{}, 0.5, b); });
  tries.all("p^t", not_finite, [](double pt) { EulerB<2, Kepler, Gamma>(Kepler{}, Gamma{}, pt); });
  tries.all("p^t", not_finite, [](double pt) { LogHamiltonian<Kepler>(Kepler{}, pt); });
}

void try_quadrature(Tries& tries) {
  tries.part = "quadrature";
  tries.all("Gauss nodes", std::vector{0, -5, 17}, [](int m) { (void)gauss(m); });
  tries.all("Lobatto nodes", std::vector{1, -5, 17}, [](int m) { (void)lobatto(m); });
  tries.all("Radau nodes", std::vector{0, -5, 17}, [](int m) { (void)radau(m); });
}

}  // namespace

void try_dynamics(Tries& tries) {
  try_loop(tries);
  try_monitors(tries);
  try_quadrature(tries);
}

}  // namespace experiment
