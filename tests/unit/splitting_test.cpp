#include "avi/avi.hpp"
#include "avi/integrators/splitting.hpp"
#include "common/problems/perturbed_kepler.hpp"
#include "difference.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
namespace c = avi::compositions;
using avi::HenonHeiles, avi::Kepler, avi::LogHamiltonian, avi::Separable, avi::State, avi::Summation,
    experiment::PerturbedKepler;

namespace splitting_test {

const State<2> henon_start = HenonHeiles::on_section(1.0 / 12.0, 0.1, 0.0);

TEST(Splitting, IsTheCompositionOfItsBaseStep) {
  auto merged = avi::splitting(Separable<HenonHeiles>{}, c::kahan_li6);
  auto base = avi::splitting(Separable<HenonHeiles>{}, c::strang);
  avi::Composition composed(base, c::kahan_li6);
  auto z = henon_start, w = henon_start;
  EXPECT_EQ(avi::integrate(merged, z, 0.1, {.steps = 50}).evaluations, 450);
  const auto run = avi::integrate(composed, w, 0.1, {.steps = 50});
  EXPECT_LT((z.q - w.q).norm() + (z.p - w.p).norm(), 1e-14);
  EXPECT_NEAR(z.t, 5.0, 3e-14);
  EXPECT_NEAR(w.t, 5.0, 3e-14);
  EXPECT_EQ(run.evaluations, 450);
  EXPECT_EQ(merged.step(z, 0.1).residual, 0.0);  // of an explicit step
}

/// The leapfrog as a map of extended phase space (q, t, p, p^t).
avi::Vector<double, avi::dynamic> extended_leapfrog(const avi::Vector<double, avi::dynamic>& x) {
  State<2> z{.q = x.segment<2>(0), .p = x.segment<2>(3), .t = x[2]};
  auto method = avi::splitting(LogHamiltonian<PerturbedKepler>(PerturbedKepler(0.05), x[5]), c::yoshida4);
  EXPECT_EQ(method.step(z, 0.2).outcome, avi::Outcome::ok);
  avi::Vector<double, avi::dynamic> image(6);
  image << z.q, z.t, z.p, x[5];
  return image;
}

TEST(LogHamiltonian, IsSymplecticInExtendedPhaseSpace) {
  const auto start = Kepler::pericentre(0.3);
  avi::Vector<double, avi::dynamic> x(6);
  x << start.q, 0.0, start.p, -PerturbedKepler(0.05)(start.q, start.p);
  EXPECT_LT(avi::symplecticity_defect(extended_leapfrog, x), 2e-11);
}

TEST(LogHamiltonian, KeepsToTheEllipseOfKepler) {
  const double e = 0.99;
  auto z = Kepler::pericentre(e);
  auto method = avi::splitting(LogHamiltonian<Kepler>({}, z), c::strang);
  double energy = 0.0, shape = 0.0;
  EXPECT_TRUE(avi::integrate(method, z, 0.1, {.steps = 1000}, [&](const State<2>& s, long) {
                energy = std::max(energy, std::abs(Kepler{}(s.q, s.p) + 0.5) * s.q.norm());
                const double x = s.q[0] + e, y = s.q[1];
                shape = std::max(shape, std::abs(x * x + y * y / (1.0 - e * e) - 1.0));
              }).ok());
  EXPECT_LT(energy, 1e-13);
  EXPECT_LT(shape, 1e-10);
}

TEST(LogHamiltonian, ShortcutsAgreeWithTheGeneralFormula) {
  const avi::Vector<double, 2> q(0.3, -0.4);
  const auto defect = [&](const auto& problem) {
    const avi::Vector<double, 2> general = 0.7 / problem.potential(q) * problem.potential_gradient(q);
    return (problem.log_potential_gradient(q, 0.7) - general).norm();
  };
  EXPECT_LT(defect(PerturbedKepler(0.1)), 1e-14);
  EXPECT_LT(defect(Kepler{}), 1e-14);
  EXPECT_THROW((LogHamiltonian<HenonHeiles>({}, henon_start)), std::invalid_argument);
  EXPECT_THROW((LogHamiltonian<HenonHeiles>({}, State<2>{.q = {0.0, 0.0}, .p = {0.1, 0.0}})),
               std::invalid_argument)
      << "the logarithm of V = 0";
}

/// A body of mass 2 without shortcuts.
struct Heavy {
  static constexpr int dimension = 2;
  using Vec = avi::Vector<double, 2>;
  static double kinetic(const Vec& p) { return 0.25 * p.squaredNorm(); }
  static Vec velocity(const Vec& p) { return 0.5 * p; }
  static double potential(const Vec& q) { return -3.0 / q.norm(); }
  static Vec potential_gradient(const Vec& q) { return 3.0 / (q.norm() * q.squaredNorm()) * q; }
};

TEST(LogHamiltonian, FlowsAreTheSlopesOfItsLogarithms) {
  const Heavy::Vec q(0.6, -0.3), p(1.0, 2.5);
  const double h = 0.7, p_t = 0.4;
  const LogHamiltonian<Heavy> flows({}, p_t);
  const auto drift = flows.drift(p, h);
  const auto kick = flows.kick(q, h);
  const auto of_p = [&](const Heavy::Vec& x) { return h * std::log(Heavy::kinetic(x) + p_t); };
  const auto of_q = [&](const Heavy::Vec& x) { return h * std::log(-Heavy::potential(x)); };
  EXPECT_LT(gradient_defect(of_p, p, drift.position, 1e-3), 1e-10);
  EXPECT_LT(gradient_defect(of_q, q, kick, 1e-3), 1e-9);
  const auto of_energy = [&](double x) { return std::log(Heavy::kinetic(p) + p_t + x); };
  EXPECT_NEAR(drift.time, h * difference(of_energy, 1e-3), 1e-10);
}

TEST(LogHamiltonian, SaysSoOutsideItsDomain) {
  // T = 9.5 at this pericentre: with p^t = -10 the logarithm of T + p^t does not exist.
  auto z = Kepler::pericentre(0.9);
  const auto start = z;
  auto method = avi::splitting(LogHamiltonian<Kepler>({}, -10.0), c::strang);
  const auto run = avi::integrate(method, z, 0.01, {.steps = 10});
  EXPECT_EQ(run.outcome, avi::Outcome::diverged);
  EXPECT_EQ(z.q, start.q);
}

/// A spring whose potential is negative near the origin only.
struct Well {
  static constexpr int dimension = 1;
  using Vec = avi::Vector<double, 1>;
  static double kinetic(const Vec& p) { return 0.5 * p[0] * p[0]; }
  static double potential(const Vec& q) { return 0.5 * q[0] * q[0] - 1.0; }
  static Vec potential_gradient(const Vec& q) { return q; }
};

TEST(LogHamiltonian, SaysSoWhereThePotentialIsNotNegative) {
  // With energy 1 the orbit, q = 2 sin t, comes to V = 0 at t = pi / 4; with -0.5 it turns before.
  for (const auto& list : {avi::split(c::strang), avi::split(c::kahan_li8)})
    for (const double h : {0.001, 0.01, 0.1, 0.2, 0.5}) {
      State<1> z{.q = {0.0}, .p = {2.0}};
      auto method = avi::splitting(LogHamiltonian<Well>({}, z), list);
      EXPECT_EQ(avi::integrate(method, z, h, {.time = 3.0, .steps = 100000}).outcome, avi::Outcome::diverged)
          << h;
      EXPECT_LT(Well::potential(z.q), 0.0);
      z = {.q = {0.0}, .p = {1.0}};
      method = avi::splitting(LogHamiltonian<Well>({}, z), list);
      EXPECT_TRUE(avi::integrate(method, z, h, {.time = 3.0, .steps = 100000}).ok()) << h;
    }
}

TEST(CompensatedSummation, KeepsTheEnergyBetterThanPlainSummation) {
  const auto worst = [](auto method) {
    auto z = henon_start;
    const double start = HenonHeiles{}(z.q, z.p);
    double energy = 0.0;
    EXPECT_TRUE(avi::integrate(method, z, 0.05, {.steps = 200000}, [&](const State<2>& s, long) {
                  energy = std::max(energy, std::abs(HenonHeiles{}(s.q, s.p) - start));
                }).ok());
    return energy;
  };
  const Separable<HenonHeiles> flows;
  const double plain = worst(avi::splitting(flows, c::kahan_li8));
  const double compensated = worst(avi::splitting<Summation::compensated>(flows, c::kahan_li8));
  EXPECT_LT(compensated, 2e-16 * 5);
  EXPECT_GT(plain, 3.0 * compensated);
}

TEST(CompensatedSummation, ForgetsWhenTheStateIsChangedFromOutside) {
  auto used = avi::splitting<Summation::compensated>(Separable<HenonHeiles>{}, c::kahan_li6);
  auto fresh = used;
  auto z = henon_start;
  EXPECT_EQ(avi::integrate(used, z, 0.1, {.steps = 20}).outcome, avi::Outcome::ok);
  z = henon_start;
  auto w = henon_start;
  EXPECT_EQ(used.step(z, 0.1).outcome, avi::Outcome::ok);
  EXPECT_EQ(fresh.step(w, 0.1).outcome, avi::Outcome::ok);
  EXPECT_EQ(z, w);
}

TEST(Splitting, RefusesListsThatDoNotAlternate) {
  const auto of = [](std::size_t drifts, std::size_t kicks) {
    using Lengths = avi::Lengths<long double>;
    Lengths a(drifts), b(kicks);
    std::fill_n(&a[0], drifts, 1.0L / static_cast<long double>(drifts));
    std::fill_n(&b[0], kicks, 1.0L / static_cast<long double>(kicks));
    (void)avi::splitting(Separable<HenonHeiles>{}, {.order = 2, .a = a, .b = b});
  };
  EXPECT_NO_THROW(of(3, 2));
  EXPECT_THROW(of(2, 2), std::invalid_argument);
  EXPECT_THROW(of(4, 2), std::invalid_argument);
}

/// A spring of any size whose gradient has two entries.
struct TwoSlopes {
  static constexpr int dimension = avi::dynamic;
  avi::VectorX potential_gradient(const avi::VectorX& q) const { return avi::VectorX::Constant(2, q[0]); }
};

/// A body of mass 2 in a well.
struct OfMassTwo {
  static constexpr int dimension = 2;
  static double kinetic(const auto& p) { return 0.25 * p.squaredNorm(); }
  static double potential(const auto& q) { return 0.5 * q.squaredNorm() - 9.0; }
  static avi::Vector<double, 2> potential_gradient(const avi::Vector<double, 2>& q) { return q; }
  double operator()(const auto& q, const auto& p) const { return kinetic(p) + potential(q); }
};
struct WithVelocity : OfMassTwo {
  static avi::Vector<double, 2> velocity(const avi::Vector<double, 2>& p) { return 0.5 * p; }
};

// Without the velocity they were taken for masses of 1, and the orbit was another one.
TEST(Splitting, RefusesMassesOfWhichItIsNotTold) {
  const State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  const char* const said = "it must be half the square of p";
  expect_refusal([] { (void)Separable(OfMassTwo()); }, said);
  expect_refusal([&] { (void)LogHamiltonian(OfMassTwo(), start); }, said);
  expect_refusal([&] { (void)avi::euler_b(OfMassTwo(), start); }, said);
  auto method = avi::splitting(Separable(WithVelocity()), c::kahan_li8);
  State<2> z = start;
  EXPECT_TRUE(avi::integrate_to(method, z, 0.05, 3.0).ok());
  EXPECT_NEAR(z.q[0], std::cos(3.0 / std::sqrt(2.0)), 4e-15);  // measured 1.2e-15
}

TEST(Splitting, RefusesAGradientOfAnotherSize) {
  const std::string sentence = "Number of entries of the gradient is 2; it must be that of q and of p, 3.";
  State<avi::dynamic> z{.q = {1.0, 2.0, 3.0}, .p = {0.0, 0.0, 0.0}};
  auto leapfrog = avi::splitting(Separable<TwoSlopes>{}, c::strang);
  EXPECT_EQ(refusal([&] { (void)avi::integrate(leapfrog, z, 0.1, {.steps = 1}); }), sentence);
  auto verlet = avi::stormer_verlet<avi::dynamic>(
      [](const avi::VectorX& q) { return TwoSlopes().potential_gradient(q); });
  EXPECT_EQ(refusal([&] { (void)avi::integrate(verlet, z, 0.1, {.steps = 1}); }), sentence);
}

}  // namespace splitting_test
