#include "avi/avi.hpp"
#include "avi/transform/poincare.hpp"
#include "common/methods/printed_htvi.hpp"
#include "difference.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

using avi::Kepler, avi::State;
using Vec = avi::Vector<double, 2>;

namespace poincare_test {

const auto of_qp = [](const auto& q, const auto& p) {
  return 1.0 + 0.5 * (q[0] * q[0]) + 0.1 * (p[1] * q[1]);
};

template <class Problem>
void expect_field_of_transformed(const Problem& problem, const State<2>& z) {
  Vec dq, dp;
  double dt = 0.0;
  problem.field(z.q, z.p, problem.energy_momentum(), dq, dp, dt);
  const auto of_q = [&](const Vec& q) { return problem.transformed({q, z.p, 0.0}); };
  const auto of_p = [&](const Vec& p) { return problem.transformed({z.q, p, 0.0}); };
  EXPECT_LT(std::max(gradient_defect(of_p, z.p, dq, 1e-3), gradient_defect(of_q, z.q, dp, 1e-3)), 1e-8);
  EXPECT_EQ(dt, problem.rate(z.q, z.p));
  // The printed action's integrand is p . q' + p^t t' - H-bar.
  EXPECT_NEAR((experiment::action_rate<false>(problem, z.q, z.p, problem.energy_momentum())),
              z.p.dot(dq) + problem.energy_momentum() * dt - problem.transformed(z), 1e-13);
  // On the level of H-bar here it is the same field, given that number.
  Vec velocity, force;
  double time = 0.0;
  problem.field_on_level(z.q, z.p, problem.transformed(z), velocity, force, time);
  EXPECT_LT((velocity - dq).norm() + (force - dp).norm(), 2e-15);
  EXPECT_EQ(time, dt);
}

/// On the shell the field is that of the orbit through z, whatever p^t the problem has.
template <class Problem>
void expect_field_on_shell(const Problem& problem, const State<2>& z) {
  const Problem through(problem.hamiltonian(), problem.monitor(), -problem.hamiltonian()(z.q, z.p));
  ASSERT_GT(std::abs(problem.transformed(z)), 0.01);
  const double pt = problem.energy_momentum();
  Vec dq, dp, velocity, force;
  double dt = 0.0, time = 0.0;
  through.field(z.q, z.p, through.energy_momentum(), dq, dp, dt);
  problem.field_on_shell(z.q, z.p, velocity, force, time);
  EXPECT_LT((velocity - dq).norm() + (force - dp).norm(), 1e-15);
  EXPECT_EQ(time, dt);
  EXPECT_NEAR((experiment::action_rate<true>(problem, z.q, z.p, pt)),
              z.p.dot(velocity) + pt * time - problem.transformed(z), 1e-14);
}

TEST(Poincare, FieldIsThatOfTheTransformedHamiltonian) {
  // Off the energy shell, where every term counts.
  const State<2> start = Kepler::pericentre(0.4), z{.q = {0.7, -0.4}, .p = {0.3, 0.9}};
  expect_field_of_transformed(avi::poincare(Kepler{}, start), z);
  expect_field_of_transformed(avi::poincare(Kepler{}, start, avi::NormSquared{}), z);
  expect_field_of_transformed(avi::poincare(Kepler{}, start, of_qp), z);
  expect_field_of_transformed(avi::poincare(avi::Automatic{Kepler{}}, start, of_qp), z);
  expect_field_on_shell(avi::poincare(Kepler{}, start), z);
  expect_field_on_shell(avi::poincare(Kepler{}, start, avi::NormSquared{}), z);
  expect_field_on_shell(avi::poincare(Kepler{}, start, of_qp), z);
}

TEST(Poincare, TakesTheDimensionAndTheEnergyFromTheStart) {
  const State<2> start = Kepler::pericentre(0.4);
  const auto problem = avi::poincare(Kepler{}, start, avi::NormSquared{});
  static_assert(decltype(problem)::dimension == 2);
  EXPECT_DOUBLE_EQ(problem.energy_momentum(), 0.5);
  EXPECT_NEAR(problem.transformed(start), 0.0, 1e-15);
  EXPECT_EQ(problem.clock(start.q, 7.0), 7.0);
  const State<avi::dynamic> same{.q = start.q, .p = start.p};
  EXPECT_EQ(avi::poincare(avi::Automatic{Kepler{}}, same).size(), 2);
}

TEST(Poincare, TakesHamiltoniansOfTheDimensionOfTheState) {
  using Free = avi::NBody<avi::dynamic>;
  EXPECT_TRUE((avi::detail::dimension_fits<Kepler, 2>));
  EXPECT_FALSE((avi::detail::dimension_fits<Kepler, 3>));
  EXPECT_TRUE((avi::detail::dimension_fits<Kepler, avi::dynamic>));
  EXPECT_TRUE((avi::detail::dimension_fits<Free, 3>));
  EXPECT_TRUE((avi::detail::dimension_fits<decltype(of_qp), 3>)) << "it does not say";
}

TEST(Poincare, RefusesWhatIsNotFinite) {
  State<2> start = Kepler::pericentre(0.4);
  start.q.setZero();
  EXPECT_THROW((void)avi::poincare(Kepler{}, start), std::invalid_argument);
  using Free = avi::Poincare<avi::dynamic, avi::Automatic<Kepler>>;
  EXPECT_THROW(Free({}, {}, 0.0, 0), std::invalid_argument);
  EXPECT_EQ(Free({}, {}, 0.0, 1).size(), 1);
}

TEST(Poincare, RefusesASizeThatIsNotTheDimension) {
  const auto free = [](const auto&, const auto& p) { return 0.5 * (p[0] * p[0]); };
  using H = decltype(free);
  EXPECT_EQ(refusal([&] { avi::Poincare<2, H>(free, {}, 0.0, 3); }),
            "Dimension of the problem is 3; it must be 2.");
  EXPECT_EQ(refusal([&] { avi::Poincare<avi::dynamic, H>(free, {}, 0.0, 0); }),
            "Dimension of the problem is 0; it must be at least 1.");
  EXPECT_EQ(refusal([&] { avi::Poincare<avi::dynamic, H>(free, {}, 0.0, 1); }), "accepted");
  // Every way from H and a start refuses the start before H sees it.
  using avi::VectorX;
  const auto in_time = [](const auto&, const auto& t, const auto& p) { return t * (p[0] * p[0]); };
  for (const auto& each :
       {std::pair<State<avi::dynamic>, std::string>{
            {.q = VectorX(), .p = VectorX()}, "Dimension of q at the start is 0; it must be at least 1."},
        {{.q = VectorX::Ones(2), .p = VectorX::Ones(3)},
         "Dimension of p at the start is 3; it must be that of q, 2."}}) {
    const auto& start = each.first;
    const std::string& sentence = each.second;
    EXPECT_EQ(refusal([&] { (void)avi::poincare(free, start); }), sentence);
    EXPECT_EQ(refusal([&] { (void)avi::time_dependent(in_time, start); }), sentence);
    EXPECT_EQ(refusal([&] { (void)avi::solve(free, start, 1.0, 1e-6); }), sentence);
  }
}

}  // namespace poincare_test
