#include "beyond/stability/bad_input/tries.hpp"
#include "common/frame.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/core/dot.hpp"
#include "avi/core/integrate.hpp"
#include "avi/diagnostics/drift.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/htvi/quadrature.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/chain.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/pendulum.hpp"
#include "avi/problems/perturbed_kepler.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"

#include <vector>

// Every entry point of the library against arguments that it cannot use: what was tried, and what it
// answered. Those of HTVI itself are in tests/stability/bad_htvi_input_test.cpp, those of the programs in
// tests/reproduction/front_door_test.cpp.

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

void try_problems(Tries& tries) {
  tries.part = "problems";
  tries.all("e", std::vector{-0.1, 1.0, nan, inf}, [](double e) { (void)Kepler::pericentre(e); });
  tries.all("e", std::vector{-0.1, 1.0, nan, inf}, [](double e) { (void)Kepler::exact(e, 1.0); });
  tries.all("t", not_finite, [](double t) { (void)Kepler::exact(0.5, t); });
  tries.all("epsilon", std::vector{-1.0, nan, inf}, [](double e) { PerturbedKepler{e}; });
  tries.all("amplitude", std::vector{-0.1, 4.0, nan}, [](double a) { (void)Pendulum::start(a); });
  tries.all("amplitude", std::vector{-0.1, 4.0, nan}, [](double a) { (void)Pendulum::period(a); });
  tries.all("mass", not_positive, [](double m) { NBody<2>({1.0, m}); });
  tries.one("bodies", 1, [] { NBody<dynamic>(Vector<double, dynamic>::Ones(1)); });
  tries.all("energy", std::vector{-1.0, nan, inf},
            [](double e) { (void)HenonHeiles::on_section(e, 0.1, 0.0); });
}

void try_diagnostics(Tries& tries) {
  tries.part = "diagnostics";
  const std::vector<double> three = {1.0, 2.0, 3.0}, two = {1.0, 2.0}, same = {1.0, 1.0, 1.0};
  tries.one("lengths", 2, [&] { (void)fit_drift(three, two); });
  tries.one("points", 2, [&] { (void)fit_drift(two, two); });
  tries.one("blocks", -1, [&] { (void)fit_drift(three, three, -1); });
  tries.one("times", 0, [&] { (void)fit_drift(same, three); });
  tries.one("lengths", 2, [&] { (void)fit_order(three, two); });
  tries.all("h", std::vector{0.0, nan, inf},
            [&](double h) { (void)fit_order(std::vector{h}, std::vector{1.0}); });
  tries.one("points", 1, [&] { (void)fit_order(three, three, {.at_least = 1}); });
  const auto identity = [](const VectorX& z) { return z; };
  tries.one("odd", 3, [&] { (void)symplecticity_defect(identity, VectorX(VectorX::Ones(3))); });
  tries.all("spacing", not_positive, [&](double s) {
    (void)difference_jacobian(identity, VectorX(VectorX::Ones(2)), {.smallest = s});
  });
}

}  // namespace

}  // namespace experiment

int main(int argc, char** argv) {
  using namespace experiment;
  return experiment::run(argc, argv, AVI_SHOWS, [&](Frame& frame) {
    Table table = frame.table({"part", "argument", "value", "ending", "sentence"});
    Tries tries(table);
    for (const auto& attempt : {try_rules, try_update_loop, try_time_loop, try_collocation, try_monitors,
                                try_quadrature, try_problems, try_diagnostics})
      attempt(tries);
    Table counts = frame.table({"part", "inputs", "refused", "taken", "named"});
    for (const auto& [part, n] : tries.tally)
      counts.row(part, n.inputs, n.refused, n.taken, n.inputs - n.refused - n.taken);
    table.note("ending", "refused with that sentence; or, where only the run can find it out, its outcome");
    frame.write(counts, "counts");
    table.note("inputs", table.rows.size());
    frame.write(table);
  });
}
