#include "avi/avi.hpp"
#include "common/methods/adaptive_verlet.hpp"
#include "common/methods/hairer_soderlind.hpp"
#include "property/combinations.hpp"

#include <gtest/gtest.h>

// See combinations.hpp.

namespace explicit_combinations_test {

using namespace combinations;

TEST(ExplicitCombinations, Autonomous) {
  const auto gradient = [](const avi::Vector<double, 1>& q) { return Quartic::potential_gradient(q); };
  check("stormer_verlet", avi::stormer_verlet<1>(gradient), start, 0.01, 1e-3);
  check("splitting", avi::splitting(avi::Separable(Quartic{}), avi::splittings::blanes_moan6), start, 0.1,
        1e-5);
  check("compensated splitting",
        avi::splitting<avi::Summation::compensated>(avi::Separable(Quartic{}), avi::compositions::kahan_li6),
        start, 0.1, 1e-5);
  check("log_hamiltonian",
        avi::splitting(avi::LogHamiltonian(Quartic{}, start), avi::compositions::kahan_li6), start, 0.5,
        1e-5);
  check("euler_b", avi::euler_b(Quartic{}, start), start, 0.001, 1e-2);
  check("euler_b, g(q)", avi::euler_b(Quartic{}, start, of_q), start, 0.001, 1e-2);
  check("adaptive_verlet, g(q, p)", experiment::AdaptiveVerlet(Quartic{}, of_qp), start, 0.01, 1e-3);
  check("hairer_soderlind",
        experiment::HairerSoderlind(avi::splitting(avi::Separable(Quartic{}), avi::compositions::strang),
                                    Controlled{}),
        start, 0.01, 1e-3);
}

TEST(ExplicitCombinations, RunTimeDimension) {
  const State<avi::dynamic> same{.q = start.q, .p = start.p, .t = start.t};
  using Problem = QuarticOf<avi::dynamic>;
  check("stormer_verlet",
        avi::stormer_verlet<avi::dynamic>([](const auto& q) { return Problem::potential_gradient(q); }), same,
        0.01, 1e-3);
  check("splitting",
        avi::splitting<avi::Summation::compensated>(avi::Separable(Problem{}), avi::splittings::blanes_moan6),
        same, 0.1, 1e-5);
  check("log_hamiltonian", avi::splitting(avi::LogHamiltonian(Problem{}, same), avi::compositions::kahan_li6),
        same, 0.5, 1e-5);
}

}  // namespace explicit_combinations_test
