#include "beyond/stability/bad_input/tries.hpp"
#include "common/frame.hpp"

#include "avi/core/dot.hpp"
#include "avi/diagnostics/drift.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/pendulum.hpp"
#include "avi/problems/perturbed_kepler.hpp"

#include <vector>

// Every entry point of the library against arguments that it cannot use: what was tried, and what it
// answered. Those of HTVI itself are in tests/stability/bad_htvi_input_test.cpp, those of the programs in
// tests/reproduction/front_door_test.cpp.

namespace experiment {

using namespace avi;

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

}  // namespace experiment

int main(int argc, char** argv) {
  using namespace experiment;
  return experiment::run(
      argc, argv, "bad_input", "Arguments that no entry point can use, and what each answered",
      [&](Frame& frame) {
        Table table = frame.table({"part", "argument", "value", "ending", "sentence"});
        Tries tries(table);
        for (const auto& attempt : {try_rules, try_update_loop, try_time_loop, try_collocation, try_monitors,
                                    try_quadrature, try_problems, try_diagnostics})
          attempt(tries);
        Table counts = frame.table({"part", "inputs", "refused", "taken", "named"});
        for (const auto& [part, n] : tries.tally)
          counts.row(part, n.inputs, n.refused, n.taken, n.inputs - n.refused - n.taken);
        table.note("ending",
                   "refused with that sentence; or, where only the run can find it out, its outcome");
        frame.write(counts, "counts");
        table.note("inputs", table.rows.size());
        frame.write(table);
      });
}
