#include "avi/avi.hpp"
#include "common/methods/printed_htvi.hpp"

#include <gtest/gtest.h>

using avi::Generating, avi::Kepler, avi::State;

namespace discrete_hamiltonian_test {

using Point = avi::Vector<double, avi::dynamic>;
constexpr double h = 0.1;

template <class Construction>
constexpr bool is_stationary = std::is_same_v<Construction, avi::Stationary>;
template <class Construction>
constexpr bool is_authors = std::is_same_v<Construction, experiment::Authors>;

/// p^t t(h) - A for the Taylor curve of an expansion, by its definition: numbers alone.
template <class Construction, class Expansion>
double less_the_action(const Expansion& e, double time, const avi::Quadrature& rule) {
  const auto& problem = e.problem();
  const int r = e.order();
  const double pt = problem.energy_momentum();
  double sum = 0.0;
  if constexpr (is_stationary<Construction>) {
    for (int i = 0; i < 2; ++i)  // the integral of p . dq; that of p^t dt cancels p^t t(h)
      for (int j = 1; j <= r + 1; ++j)
        for (int k = 0; k <= r; ++k)
          sum -= static_cast<double>(j) / (j + k) * e.q()[i][j].value() * e.p()[i][k].value();
  } else {
    sum = pt * time;
  }
  for (std::size_t node = 0; node < rule.nodes.size(); ++node) {
    const double c = rule.nodes[node], weight = h * rule.weights[node];
    const bool raised = is_stationary<Construction> || (is_authors<Construction> && c == 1.0);
    avi::Vector<double, 2> q(0.0, 0.0), p(0.0, 0.0);
    for (int i = 0; i < 2; ++i) {
      for (int k = raised ? r + 1 : r; k >= 0; --k)
        q[i] = q[i] * c + e.q()[i][k].value();
      for (int k = r; k >= 0; --k)
        p[i] = p[i] * c + e.p()[i][k].value();
    }
    if constexpr (is_stationary<Construction>)
      sum += weight * problem.rate(q, p) * (problem.hamiltonian()(q, p) + pt);
    else
      sum -= weight * experiment::action_rate<is_authors<Construction>>(problem, q, p, pt);
  }
  return sum;
}

/// H_d^+(q_0, p_1) - p_1 . q_0, or H_d^-(q_1, p_0) + p_0 . q_1, by its definition alone: the expansion point
/// is found by Newton's method, the Taylor polynomials and the quadrature are summed, nothing is
/// differentiated. Up to that the discrete Hamiltonian is a plain function of four numbers.
template <Generating type, class Construction, class Expansion>
double discrete_hamiltonian(Expansion& expansion, const avi::Quadrature& rule, const Point& x) {
  constexpr bool right = type == Generating::type2;
  avi::Vector<double, 2> q = x.head<2>(), p = x.tail<2>();
  auto d = expansion.expand(q, p, h);
  for (int k = 0; k < 30; ++k) {
    avi::Vector<double, 2> miss;
    avi::Matrix<double, 2> slope;
    for (int i = 0; i < 2; ++i) {
      miss[i] = right ? x[2 + i] - p[i] - d.p[i].value() : x[i] - q[i] - d.q[i].value();
      for (int j = 0; j < 2; ++j)
        slope(i, j) = (i == j) + (right ? d.p[i].partial(2 + j) : d.q[i].partial(j));
    }
    (right ? p : q) += avi::inverse<2>(slope) * miss;
    d = expansion.expand(q, p, h);
  }
  double value = less_the_action<Construction>(expansion, d.t.value(), rule);
  for (int i = 0; i < 2; ++i)
    value += x[2 + i] * d.q[i].value();
  return value;
}

/// Type II: p_0 = p_1 + dS/dq_0, q_1 = q_0 + dS/dp_1; Type III: p_1 = p_0 - dS/dq_1, q_0 = q_1 - dS/dp_0.
template <Generating type, class Construction, class Problem>
double gap_to_the_definition(const Problem& problem, int r) {
  constexpr bool right = type == Generating::type2;
  const State<2> z = Kepler::exact(0.6, 0.9);
  State<2> next = z;
  auto method = avi::htvi_of_order<type, Construction>(r, problem, avi::simpson());
  EXPECT_EQ(method.step(next, h).outcome, avi::Outcome::ok);
  Point x(4);
  if (right)
    x << z.q, next.p;
  else
    x << next.q, z.p;
  // The stationary one follows the field on the level of H-bar there, and the full field here.
  using Followed = std::conditional_t<is_stationary<Construction>, experiment::Printed, Construction>;
  avi::TaylorExpansion<Problem, avi::dynamic, Followed> expansion(problem, r);
  const auto jacobian = avi::difference_jacobian(
      [&](const Point& y) -> Point {
        return Point::Constant(4, discrete_hamiltonian<type, Construction>(expansion, avi::simpson(), y));
      },
      x);
  const Point slope = jacobian.row(0).transpose();
  return std::max((z.p - next.p - slope.head<2>()).norm(), (next.q - z.q - slope.tail<2>()).norm());
}

template <class Construction, class G>
void expect_definition(const G& monitor) {
  // Off the energy shell, so that no term of H + p^t hides.
  const State<2> z = Kepler::exact(0.6, 0.9);
  const avi::Poincare<2, Kepler, G> problem(Kepler{}, monitor, 0.02 - Kepler{}(z.q, z.p));
  for (int r : {0, 1, 2, 4}) {
    EXPECT_LT((gap_to_the_definition<Generating::type2, Construction>(problem, r)), 1e-11) << r;
    EXPECT_LT((gap_to_the_definition<Generating::type3, Construction>(problem, r)), 1e-11) << r;
  }
}

TEST(DiscreteHamiltonian, GeneratesTheStepInEveryConstruction) {
  const auto gamma = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  expect_definition<experiment::Printed>(gamma);
  expect_definition<experiment::Authors>(gamma);
  expect_definition<avi::Stationary>(gamma);
}

TEST(DiscreteHamiltonian, GeneratesTheStepWithAMonitorOfTheMomentum) {
  const auto energy = avi::bounded(avi::Energy{Kepler{}, 0.5}, 1e-4, 2.0);
  expect_definition<experiment::Printed>(energy);
  expect_definition<avi::Stationary>(energy);
}

}  // namespace discrete_hamiltonian_test
