#include "allocations.hpp"
#include "avi/avi.hpp"
#include "common/methods/printed_htvi.hpp"
#include "common/problems/chain.hpp"
#include "rate.hpp"
#include "src/autodiff/rounded_formula.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

namespace allocation_test {

template <class Method, class State = avi::State<2>>
void expect_none(Method method, double h, State z = avi::Kepler::pericentre(0.9)) {
  const long before = allocations;
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
  EXPECT_EQ(allocations - before, 0) << "of steps of " << h;
}

TEST(Step, AllocatesNothing) {
  const avi::Kepler kepler;
  const auto z = avi::Kepler::pericentre(0.9);
  const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  const auto problem = avi::poincare<2>(avi::Automatic{kepler}, z, monitor);
  expect_none(avi::type2<3, experiment::Authors>(avi::poincare<2>(kepler, z, monitor), avi::simpson()), 0.1);
  expect_none(avi::type2<3, experiment::Printed>(problem, avi::simpson()), 0.1);
  expect_none(avi::htvi<8>(problem), 0.1);
  expect_none(avi::euler_b<2>(kepler, z, monitor), 0.01);
  expect_none(avi::stormer_verlet<2>(&avi::Kepler::potential_gradient<double>), 1e-4);
}

// A charge in a dipole's field, whose sweeps converge by 0.6 each: a matrix of Newton's method, which comes
// with memory, would cost more than the few that are left.
TEST(Step, IsSolvedBySweepsThatAreNearlyThere) {
  const avi::State<3> start{.q = {1.0, 0.0, 0.0}, .p = {0.0, 1.08, 0.03}};
  auto method = avi::collocation(avi::poincare(systems::dipole, start), 16, {.tolerance = 1e-9});
  for (const double h : {1.15, 1.25}) {
    auto z = start;
    const long before = allocations;
    for (int k = 0; k < 40; ++k)
      EXPECT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
    EXPECT_EQ(allocations - before, 0);
  }
}

TEST(Step, AllocatesNothingInCollocationEither) {
  const auto z = avi::Kepler::pericentre(0.9);
  const auto chain = experiment::Chain::plucked(12);  // its dimension is known at run time only
  for (const int order : {4, 16}) {
    expect_none(avi::collocation(avi::poincare(avi::Kepler{}, z, avi::NormSquared{}), order), 0.1);
    expect_none(avi::collocation(avi::poincare(experiment::Chain{}, chain, Rate{}), order), 0.2, chain);
    // So long that Newton's method takes over, in a method and in its copy: its matrix comes with the first
    // such step.
    auto stiff = avi::collocation(avi::poincare(experiment::Chain{}, chain), order);
    auto there = chain;
    EXPECT_EQ(stiff.step(there, 6.0).outcome, avi::Outcome::ok);
    expect_none(stiff, 6.0, there);
  }
}

// The formulas of a Solver are made once: the rest of a run asks for memory a few hundred times.
TEST(Solver, MakesItsFormulasOnce) {
  const avi::State<2> start{.q = {0.3, 0.0}, .p = {0.0, 2.3}}, other{.q = {0.3, 0.0}, .p = {0.0, 2.35}};
  for (const bool check : {true, false}) {
    const auto count = [&](const auto& call) {
      const long before = allocations;
      call();
      return allocations - before;
    };
    const long all = count([&] { (void)avi::solve(systems::kepler, start, 8.0, 1e-7, {.check = check}); });
    const avi::Solver solver(systems::kepler, start, 8.0, 1e-7, {.check = check, .monitor = "energy"});
    (void)solver.run(start, 8.0);  // machine code is made by the first run
    const long run = count([&] { (void)solver.run(other, 8.0); });
    EXPECT_LT(run, 600) << all;  // measured 444, and 1022 where each run makes its own
  }
}

// Memory that grows node by node would cost the square of their number.
TEST(RoundedFormula, TakesItsMemoryAtOnce) {
  const auto sum = avi::Formula::of_point(
      [](const auto& x) {
        auto all = x[0];
        for (int i = 1; i < 1000; ++i)
          all += sqrt(x[0] + i);
        return all;
      },
      1);
  const std::vector<double> at{0.3};
  avi::detail::RoundedFormula formula(sum.graph(), sum.node());
  const long before = allocations;
  EXPECT_GT(formula.rounded_once(at), 2e4);
  EXPECT_LE(allocations - before, 2);  // by operator new, which asks malloc; 7994 where each node asks
}

TEST(Step, CounterCounts) {
#ifdef COUNTS_MALLOC
  const long empty = allocations;
  avi::Vector<double, avi::dynamic> vector(100);
  vector.setOnes();
  EXPECT_GT(allocations, empty);
#endif
  const long before = allocations;
  int* volatile one = new int(1);  // volatile: a pair of new and delete may otherwise be left out
  delete one;
  EXPECT_GT(allocations, before);
}

}  // namespace allocation_test
