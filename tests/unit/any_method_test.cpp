#include "avi/core/any_method.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate_to.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/poincare.hpp"

#include <gtest/gtest.h>

namespace any_method_test {

using avi::AnyMethod, avi::Kepler, avi::State;

const auto force = [](const avi::Vector<double, 2>& q) { return Kepler::potential_gradient(q); };

TEST(AnyMethod, StepsAsWhatIsInIt) {
  const State<2> start = Kepler::pericentre(0.5);
  auto verlet = avi::stormer_verlet<2>(force);
  auto gauss = avi::collocation(avi::poincare(Kepler(), start), 8);
  for (AnyMethod<2> any : {AnyMethod<2>(verlet), AnyMethod<2>(gauss)}) {
    State<2> one = start, other = start, third = start;
    const avi::Run run = integrate(any, one, 0.01, {.steps = 100});
    const bool is_verlet = run.evaluations == 100;
    const avi::Run direct = is_verlet ? avi::integrate(verlet, other, 0.01, {.steps = 100})
                                      : avi::integrate(gauss, other, 0.01, {.steps = 100});
    EXPECT_EQ(one, other);
    EXPECT_EQ(run.evaluations, direct.evaluations);
    long seen = 0;
    AnyMethod<2> fresh = is_verlet ? AnyMethod<2>(avi::stormer_verlet<2>(force))
                                   : AnyMethod<2>(avi::collocation(avi::poincare(Kepler(), start), 8));
    (void)avi::integrate(fresh, third, 0.01, {.steps = 100}, [&](const State<2>&, long k) { seen = k; });
    EXPECT_EQ(seen, 100) << "with an observer";
    EXPECT_EQ(third, one);
  }
}

/// A method that remembers how often it was asked.
struct Counter {
  int steps = 0;
  avi::StepReport step(State<2>& z, double h) {
    ++steps;
    z.t += h * steps;
    return {};
  }
};

TEST(AnyMethod, HasACopyOfItsOwn) {
  AnyMethod<2> first = Counter{}, second = first;
  State<2> z = Kepler::pericentre(0.5);
  (void)first.step(z, 1.0);
  (void)first.step(z, 1.0);
  EXPECT_EQ(z.t, 3.0);
  z.t = 0.0;
  (void)second.step(z, 1.0);
  EXPECT_EQ(z.t, 1.0);
  second = first;
  (void)second.step(z, 1.0);
  EXPECT_EQ(z.t, 4.0);
}

TEST(AnyMethod, EndsAtATime) {
  AnyMethod<2> any = avi::stormer_verlet<2>(force);
  State<2> z = Kepler::pericentre(0.5);
  const avi::Run run = avi::integrate_to(any, z, 0.01, 1.2345);
  EXPECT_TRUE(run.ok());
  EXPECT_EQ(z.t, 1.2345);
}

}  // namespace any_method_test
