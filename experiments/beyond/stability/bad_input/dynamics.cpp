#include "beyond/stability/bad_input/tries.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/htvi/quadrature.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/chain.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"

#include <vector>

namespace experiment {

using namespace avi;

namespace {
/// g = a + b q_1, or one over it: one type for all monitors here, so that collocation is compiled once.
struct Monitor {
  double a = 1.0, b = 0.0;
  bool inverse = false;
  template <class Q>
  auto operator()(const Q& q) const {
    using S = std::decay_t<decltype(q[0] * q[0])>;
    const S g = a + b * q[0];
    return inverse ? S(1.0 / g) : g;
  }
};
}  // namespace

void try_time_loop(Tries& tries) {
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

void try_collocation(Tries& tries) {
  tries.part = "collocation";
  const auto start = Kepler::pericentre(0.5);
  const auto steps = [](const Monitor& monitor, State<2> z, double h) {
    auto method = collocation(poincare(Kepler{}, Kepler::pericentre(0.5), monitor), 8);
    return integrate(method, z, h, {.steps = 100});
  };
  const auto problem = poincare(Kepler{}, start, Monitor{});
  tries.all("order", std::vector{-2, 0, 1, 3, 7, 33, 34}, [&](int order) { collocation(problem, order); });
  tries.all("tolerance", not_positive, [&](double t) { collocation(problem, 8, {.tolerance = t}); });
  tries.all("sweeps", std::vector{0, -1}, [&](int n) { collocation(problem, 8, {.max_sweeps = n}); });
  tries.all("h", std::vector{0.0, nan, inf, -inf}, [&](double h) { (void)steps({}, start, h); });
  for (const double x : not_finite) {
    auto from = start;
    from.q[0] = x;
    tries.run("q at the start", x, [&] { return steps({}, from, 0.1); });
    from = start;
    from.p[1] = x;
    tries.run("p at the start", x, [&] { return steps({}, from, 0.1); });
  }
  for (const double g : {0.0, -1.0, nan, inf})
    tries.run("g", g, [&] { return steps({.a = g}, start, 0.1); });
  // Good at the start; zero, and infinite, farther on.
  tries.run("g on the way", "q_1", [&] { return steps({.a = 0.0, .b = 1.0}, start, 3.0); });
  tries.run("g on the way", "1/(1 + q_1)", [&] { return steps({.b = 1.0, .inverse = true}, start, 0.1); });
  tries.one("size", 2, [&] {
    auto method = collocation(poincare(Chain{}, Chain::plucked(3)), 8);
    auto z = Chain::plucked(2);
    (void)method.step(z, 0.1);
  });
  auto uneven = Chain::plucked(3);
  uneven.p = Chain::plucked(2).p;
  tries.one("size", 2, [&] {
    auto method = collocation(poincare(Chain{}, Chain::plucked(3)), 8);
    (void)method.step(uneven, 0.1);
  });
  tries.one("size", 2, [&] { (void)poincare(Chain{}, uneven); });
}

}  // namespace experiment
