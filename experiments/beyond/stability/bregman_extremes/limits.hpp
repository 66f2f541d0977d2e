#pragma once
#include "beyond/stability/bregman_extremes/overflow.hpp"
#include "common/rules/bregman_cloning.hpp"
#include "common/rules/rules.hpp"

#include <string>

// The largest stable step of each method for Bregman dynamics on a quadratic, compared with linear theory.

namespace experiment {

/// Largest z = h omega for which a composition is stable on x'' = -omega^2 x: the first z at which |trace| of
/// the step's matrix exceeds 2.
inline double linear_limit(const MergedStages& stages) {
  const auto stable = [&](double z) {
    double m[2][2] = {{1.0, 0.0}, {0.0, 1.0}};  // columns: images of (x, v) = (1, 0) and (0, 1)
    for (auto& [x, v] : m) {
      for (std::size_t i = 0; i < stages.b.size(); ++i) {
        x += stages.b[i] * z * v;
        if (i < stages.a.size()) v -= stages.a[i] * z * x;
      }
    }
    return std::abs(m[0][0] + m[1][1]) <= 2.0;
  };
  double z = 0.0;
  while (stable(z + 1e-5))
    z += 1e-5;
  return z;
}

/// The stability limit of a method by name: z = sqrt(C) P h t^(p/2 - s) sqrt(lambda_max) must stay below it.
/// For HTVI and the other leapfrogs it is 2: C h^2 P^2 t^(p-2s) lambda_max < 4.
inline double linear_limit(const std::string& method) {
  if (method == "runge_kutta_4") return 2.0 * std::sqrt(2.0);  // |R(iz)| = 1
  for (const auto composition : {CloneComposition::yoshida4, CloneComposition::yoshida6})
    if (method == clone_name(composition)) return linear_limit(merged_stages(composition));
  return 2.0;
}

/// The measured limit of a method.
struct Limit {
  double expected = 0.0;     ///< Fictive step by linear theory, at the time in [1, T] where it is least.
  double measured = 0.0;     ///< Fictive step by bisection.
  avi::Minimisation beyond;  ///< A run five per cent above the limit, with the default bounds.
};

/// Largest h for which f = |x|^2 / 2, which is 1/2 at t = 1, stays below 1000 until t = T.
///
/// With C = 1e9 steps are so small that coefficients hardly change from one step to the next, and an
/// instability has many steps in which to grow. The limit is therefore sharp.
inline Limit largest_stable_step(const std::string& method, double p, double p_ring, double T) {
  const auto family = avi::BregmanFamily::adaptive(p, p_ring, 1e9);
  const double steepest = std::max(1.0, std::pow(T, 0.5 * family.p - family.s()));
  Limit limit;
  limit.expected = linear_limit(method) / (family.order() * std::sqrt(family.C) * steepest);
  const auto run = [&](double h, const avi::Stopping& stopping) {
    const Rule rule{.method = method, .family = family, .h = h, .from = {.t = 1.0, .momentum = 0.0}};
    return run_updates(rule, Bowl{1.0}, avi::VectorX::Ones(1), stopping);
  };
  const double span = std::expm1(family.s() * std::log(T));
  const auto stable = [&](double h) {
    const avi::Stopping stopping{
        .delta = 0.0, .iterations = std::max(1L, static_cast<long>(span / h)), .growth = 1e3};
    return run(h, stopping).outcome == avi::Outcome::step_limit;
  };
  double low = 0.9 * limit.expected, high = 1.6 * limit.expected;
  for (int i = 0; i < 14; ++i) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  limit.measured = low;
  limit.beyond = run(1.05 * low, {.delta = 0.0, .iterations = 1'000'000});
  return limit;
}

}  // namespace experiment
