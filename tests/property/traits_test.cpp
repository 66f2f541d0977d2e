#include "avi/avi.hpp"
#include "common/methods/adaptive_verlet.hpp"
#include "common/methods/hairer_soderlind.hpp"
#include "distance.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

// What each method of integrators/ and transform/ says of itself, measured: order against the exact orbit of
// Kepler's problem, symplecticity by the Jacobian of a step, symmetry by going forth and back, memory by a
// step of a fresh method.

namespace traits_test {

using avi::Kepler, avi::State;

constexpr double eccentricity = 0.3;
const State<2> start = Kepler::exact(eccentricity, 0.7);  // nothing vanishes there

template <class M>
double measured_order(const M& method) {
  std::vector<double> steps, errors;
  // Far enough from the largest step that works, and from round-off.
  const int order = method.order();
  const double first = order <= 2 ? 0.05 : order <= 4 ? 0.15 : 0.5;
  for (double h = first; h > 0.1 * first; h *= 0.75) {
    M fresh = method;
    State<2> z = start;
    if (avi::integrate_to(fresh, z, h, 5.0).outcome != avi::Outcome::ok) continue;
    const State<2> exact = Kepler::exact(eccentricity, 5.0);
    steps.push_back(h);
    errors.push_back((z.q - exact.q).norm() + (z.p - exact.p).norm());
  }
  return avi::fit_order(steps, errors, {.floor = 1e-12, .at_most = 5}).order;
}

/// Largest distance from the start after 20 steps and 20 back.
template <class M>
double there_and_back(M method) {
  State<2> z = start;
  EXPECT_EQ(avi::integrate(method, z, 0.1, {.steps = 20}).outcome, avi::Outcome::ok);
  EXPECT_EQ(avi::integrate(method, z, -0.1, {.steps = 20}).outcome, avi::Outcome::ok);
  return std::max({(z.q - start.q).norm(), (z.p - start.p).norm(), std::abs(z.t - start.t)});
}

/// How far a step of this method from where it has come to is from a fresh one's.
template <class M>
double depends_on_the_past(M method) {
  M fresh = method;
  State<2> z = start;
  EXPECT_EQ(avi::integrate(method, z, 0.1, {.steps = 3}).outcome, avi::Outcome::ok);
  State<2> anew = z;
  EXPECT_EQ(method.step(z, 0.1).outcome, avi::Outcome::ok);
  EXPECT_EQ(fresh.step(anew, 0.1).outcome, avi::Outcome::ok);
  return distance(z, anew);
}

/// @param remembers the least that a step changes with the past, unless the method is a one-step method
template <class M>
void check(const char* name, const M& method, int order, double remembers = 1e-9) {
  SCOPED_TRACE(name);
  EXPECT_EQ(method.order(), order);
  EXPECT_NEAR(measured_order(method), order, order < 8 ? 0.25 : 0.6);
  const double defect = avi::symplecticity_defect(method, start, 0.1);
  if (M::symplectic)
    EXPECT_LT(defect, 1e-11);
  else
    EXPECT_GT(defect, 1e-6);
  const double memory = depends_on_the_past(method);
  if (avi::detail::one_step<M>)
    EXPECT_LT(memory, 1e-15);
  else
    EXPECT_GT(memory, remembers);
  const double lost = there_and_back(method);
  if (M::symmetric)
    EXPECT_LT(lost, 1e-13);
  else
    EXPECT_GT(lost, 1e-6);
}

const auto gradient = [](const auto& q) { return Kepler::potential_gradient(q); };
const auto verlet = avi::stormer_verlet<2>(gradient);
const avi::Separable separable{Kepler{}};
const avi::LogHamiltonian logarithmic(Kepler{}, start);
const experiment::PowerOfRadius radius{1.5};

TEST(Traits, OfPlainMethods) {
  check("stormer_verlet", verlet, 2);
  check("splitting strang", avi::splitting(separable, avi::compositions::strang), 2);
  check("splitting suzuki4", avi::splitting(separable, avi::compositions::suzuki4), 4);
  check("splitting kahan_li6", avi::splitting(separable, avi::compositions::kahan_li6), 6);
  check("splitting blanes_moan4", avi::splitting(separable, avi::splittings::blanes_moan4), 4);
  check("splitting blanes_moan6", avi::splitting(separable, avi::splittings::blanes_moan6), 6);
  check("splitting nystrom", avi::splitting(separable, avi::splittings::blanes_moan6_nystrom), 6);
  check("splitting kahan_li8",
        avi::splitting<avi::Summation::compensated>(separable, avi::compositions::kahan_li8), 8,
        6e-17);  // a rounding error; measured 1.3e-16
  check("composition yoshida4", avi::Composition(verlet, avi::compositions::yoshida4), 4);
  check("composition kahan_li6", avi::Composition(verlet, avi::compositions::kahan_li6), 6);
  check("composition kahan_li8", avi::Composition(verlet, avi::compositions::kahan_li8), 8);
  check("euler_b", avi::euler_b(Kepler{}, start), 1);
}

TEST(Traits, OfAdaptiveMethods) {
  check("euler_b with a monitor", avi::euler_b(Kepler{}, start, avi::NormSquared{}), 1);
  check("log_hamiltonian strang", avi::splitting(logarithmic, avi::compositions::strang), 2);
  check("log_hamiltonian yoshida6", avi::splitting(logarithmic, avi::compositions::yoshida6), 6);
  const experiment::AdaptiveVerlet adaptive(Kepler{}, radius);
  check("adaptive_verlet", adaptive, 2);
  // Composed it has order 4, too, with errors too uneven for a fit: its density alternates.
  check("hairer_soderlind", experiment::HairerSoderlind(verlet, radius), 2);
  check("hairer_soderlind composed",
        avi::Composition(experiment::HairerSoderlind(verlet, radius), avi::compositions::suzuki4), 4);
  check("hairer_soderlind of order 4",
        experiment::HairerSoderlind(avi::splitting(separable, avi::splittings::blanes_moan4), radius), 4);
  check("hairer_soderlind of order 6",
        experiment::HairerSoderlind(avi::splitting(separable, avi::compositions::kahan_li6), radius), 6);
}

// One gradient a step: the closing kick's is the next opening kick's.
TEST(Traits, AnExplicitStepIsOneEvaluation) {
  int calls = 0;
  auto counted = avi::stormer_verlet<2>([&](const auto& q) { return ++calls, gradient(q); });
  State<2> z = start;
  for (int k = 0; k < 7; ++k)
    EXPECT_EQ(counted.step(z, 0.1).outcome, avi::Outcome::ok);
  EXPECT_EQ(calls, 1 + 7);
  const auto evaluations = [](auto method) {
    State<2> moved = start;
    const avi::Run run = avi::integrate(method, moved, 0.1, {.steps = 7});
    EXPECT_EQ(run.outcome, avi::Outcome::ok);
    return run.evaluations;
  };
  EXPECT_EQ(evaluations(verlet), 7);
  EXPECT_EQ(evaluations(experiment::AdaptiveVerlet(Kepler{}, radius)), 7);
  EXPECT_EQ(evaluations(avi::euler_b(Kepler{}, start)), 7);
  EXPECT_EQ(evaluations(avi::euler_b(Kepler{}, start, avi::NormSquared{})), 7);
  EXPECT_EQ(evaluations(avi::Composition(verlet, avi::compositions::suzuki4)), 5 * 7);
}

TEST(Traits, UnsymmetricCoefficientsAreRefused) {
  auto list = avi::compositions::suzuki4;
  std::swap(list.c[0], list.c[2]);
  EXPECT_THROW((void)avi::Composition(verlet, list), std::invalid_argument);
  EXPECT_THROW((void)avi::splitting(separable, list), std::invalid_argument);
  auto lengths = avi::splittings::blanes_moan4;
  lengths.b[0] += 0.01L;
  EXPECT_THROW((void)avi::splitting(separable, lengths), std::invalid_argument);
}

TEST(Traits, CoefficientsThatMakeNoWholeStepAreRefused) {
  auto list = avi::compositions::yoshida4;
  list.c[1] += 1.0L;
  EXPECT_NE(refusal([&] { (void)avi::Composition(verlet, list); }), "accepted");
  EXPECT_NE(refusal([&] { (void)avi::splitting(separable, list); }), "accepted");
  EXPECT_NE(refusal([&] { (void)avi::Composition(verlet, {4, avi::Lengths<long double>(0)}); }), "accepted");
  auto lengths = split(avi::compositions::strang);
  lengths.b[0] = 2.0L;
  EXPECT_EQ(refusal([&] { (void)avi::splitting(separable, lengths); }),
            "List of kicks is 2; it must be 1 in sum.");
}

}  // namespace traits_test
