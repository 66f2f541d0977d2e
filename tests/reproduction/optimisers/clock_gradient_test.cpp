#include "optimisers/optimiser_arena/problems/problem.hpp"

#include "avi/bregman/bregman_hamiltonian.hpp"
#include "avi/diagnostics/symplecticity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

// What the terms in grad g bring and cost when the clock of Bregman dynamics follows the state
// (docs/optimisation.md).

using arena::Problem, avi::VectorX;

namespace clock_gradient_test {

/// The symplectic Euler method (Type II, order 0) for g (H + r^t), with H of order 2 and the monitor
/// g(q) = (|grad f(q)|^2 / |grad f(q_0)|^2 + 1e-4)^(-1/6), which on a quartic keeps the step at a fixed part
/// of the stable one. r' has the term -s grad g, s = H + r^t, and the step an equation for s of second
/// degree. Without the terms s = 0: the clock is frozen over a step.
struct Ball {
  const Problem& problem;
  double h, first;  ///< Step, and |grad f(q_0)|.
  bool terms;
  avi::BregmanFamily family = avi::BregmanFamily::direct(2.0);

  /// Advances z, whose value and gradient are f and g; false where the step has no solution.
  bool step(avi::ExtendedPoint& z, double f, const VectorX& g) const {
    const double size = avi::norm(g), square = size * size + 1e-4 * first * first;
    const double monitor = std::pow(square / (first * first), -1.0 / 6.0), t = z.t;
    const double kinetic = family.kinetic(t) - h * monitor * family.kinetic_rate(t);
    const double rest = (family.potential(t) - h * monitor * family.potential_rate(t)) * f + z.r_t;
    z.r -= h * monitor * family.potential(t) * g;
    if (terms) {  // grad g = -g f'' grad f / (3 square), f'' grad f by a central difference
      VectorX ahead(g.size()), behind(g.size());
      const double apart = 1e-4 * std::max(avi::norm(z.q), 1e-3) / size;
      problem.f(z.q + apart * g, ahead), problem.f(z.q - apart * g, behind);
      const VectorX b = (-h * monitor / (6.0 * apart * square)) * (ahead - behind);
      const double two = -0.5 * kinetic * avi::dot(b, b), one = 1.0 + kinetic * avi::dot(z.r, b);
      const double zero = -0.5 * kinetic * avi::dot(z.r, z.r) - rest, root = one * one - 4.0 * two * zero;
      if (!(root >= 0.0)) return false;
      z.r += (2.0 * zero / (one + std::copysign(std::sqrt(root), one))) * b;
    }
    z.r_t -= h * monitor * (0.5 * family.kinetic_rate(t) * avi::dot(z.r, z.r) + family.potential_rate(t) * f);
    z.q += h * monitor * family.kinetic(t) * z.r;
    z.t += h * monitor;
    return true;
  }

  /// Updates until |grad f| <= 1e-6 |grad f(q_0)|, with a restart where grad f . r > 0; `cap` where that does
  /// not come.
  [[nodiscard]] long count(long cap) const {
    VectorX g(problem.x0.size());
    double f = problem.f(problem.x0, g);
    const double f0 = f;
    const auto start = [&](const VectorX& q) {
      return avi::ExtendedPoint{
          .q = q, .t = 1.0, .r = VectorX::Zero(q.size()), .r_t = -family.potential(1.0) * f};
    };
    avi::ExtendedPoint z = start(problem.x0);
    for (long k = 0; k < cap; ++k) {
      const double size = avi::norm(g);
      if (size <= 1e-6 * first && f <= f0) return k;
      if (!(size <= 1e3 * first) || !std::isfinite(f) || !step(z, f, g)) return cap;
      f = problem.f(z.q, g);
      if (avi::dot(g, z.r) > 0.0) z = start(z.q);
    }
    return cap;
  }
};

TEST(ClockGradient, WithItsTermsTheStepIsSymplecticInExtendedSpace) {
  const auto problems = arena::classic_problems();
  const Problem& valley = problems.front();  // Rosenbrock's: z = (q, t, r, r^t) has six entries
  for (bool terms : {true, false}) {
    const Ball ball{valley, 0.01, 200.0, terms};
    const auto map = [&](const VectorX& at) {
      avi::ExtendedPoint z{.q = at.head(2), .t = at[2], .r = at.segment(3, 2), .r_t = at[5]};
      VectorX g(2), out(6);
      const double f = valley.f(z.q, g);
      EXPECT_TRUE(ball.step(z, f, g));
      out << z.q, z.t, z.r, z.r_t;
      return out;
    };
    VectorX z(6);
    z << -1.0, 0.5, 1.3, 0.4, -0.7, 2.0;
    const double defect = avi::symplecticity_defect(map, z, {.largest = 1e-3, .smallest = 1e-3});
    std::printf("%s the terms: %.2g\n", terms ? "with" : "without", defect);
    if (terms)
      EXPECT_LT(defect, 1e-6);
    else
      EXPECT_GT(defect, 1e-3);
  }
}

TEST(ClockGradient, TheTermsSeldomPay) {
  // Tuned problems of at most 100 dimensions, each at the best of the steps 2^(-k), at most 1500 updates.
  constexpr long cap = 1500;
  double logs = 0.0;
  int both = 0, halved = 0, only[2] = {0, 0};
  for (const Problem& problem : arena::all_problems(false, false)) {
    if (problem.group != "tuned" || problem.x0.size() > 100) continue;
    VectorX g(problem.x0.size());
    problem.f(problem.x0, g);
    long least[2] = {cap, cap};
    for (bool terms : {false, true})
      for (int k = -4; k <= 8; ++k)
        least[terms] =
            std::min(least[terms], Ball{problem, std::exp2(-k), avi::norm(g), terms}.count(least[terms]));
    const auto [frozen, with] = least;
    if (frozen < cap || with < cap)
      std::printf("%-22s frozen %4ld, with the terms %4ld\n", problem.name.c_str(), frozen, with);
    if (frozen < cap && with < cap)
      ++both, halved += 2 * with < frozen,
          logs += std::log(static_cast<double>(with) / static_cast<double>(frozen));
    else if (frozen < cap || with < cap)
      ++only[with < cap];
  }
  std::printf("both %d, of which the terms halve %d; only frozen %d, only with %d; mean ratio %.2f\n", both,
              halved, only[0], only[1], std::exp(logs / both));
  EXPECT_GT(std::exp(logs / both),
            1.2);                   // measured 1.52, before the product f'' grad f of every step is counted
  EXPECT_LE(halved, 2);             // measured 0 of 19
  EXPECT_GE(only[0] - only[1], 4);  // measured 7 and 1
}

}  // namespace clock_gradient_test
