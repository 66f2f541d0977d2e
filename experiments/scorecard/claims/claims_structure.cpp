#include "scorecard/claims/claims.hpp"

// Claims on what adaptivity keeps and gains (symplecticity, eccentricity, a monitor that was discarded) and
// on the dynamics that are integrated.

namespace scorecard {
namespace {

/// Ratio of the steps of fixed HTVI4 to adaptive HTVI4 at one position error.
Finding low_eccentricity(const Results& data) {
  Cases low;
  double most = 0.0, least = 1.0, high = 0.0;
  for (const Comparison& at : comparisons(data("eccentricity_gain"), {"eccentricity"}, {"none", "gamma"})) {
    const double e = at("none", "eccentricity"), gain = at.ratio("steps", "none", "gamma");
    if (e < 0.25) low.add(true, gain), most = e;
    if (e > 0.85) high = gain, least = e;
  }
  return finding(low.most < 1.2 && high > 3.0 ? Ruling::holds
                 : high > low.most            ? Ruling::in_part
                                              : Ruling::fails,
                 "At one position error fixed HTVI4 takes at most {:.2f} times the steps of adaptive HTVI4 "
                 "up to e = {:.1f}, and {:.1f} times at e = {:.1f}.",
                 low.most, most, high, least);
}

/// Defects of one step are round-off where they are below this; differences are good to about 1e-12.
constexpr double round_off = 2e-11;

Finding symplectic_adaptivity(const Results& data) {
  Cases cases;
  for (const Row& row : data.rows("symplecticity", {{"problem", "kepler"}}))
    cases.add(row.number("defect") < round_off, row.number("defect"));
  return finding(
      theorem(cases),
      "One step of HTVI4 and of Euler-B misses a symplectic map by at most {:.1e}, whatever h: round-off.",
      cases.most);
}

Finding splitting_is_symplectic(const Results& data) {
  const auto defect = [&](const char* method, const char* variables, const char* h) {
    return data.number("symplecticity", {{"method", method}, {"variables", variables}, {"h", h}}, "defect");
  };
  const double coarse = defect("splitting", "q t r r^t", "0.01"),
               fine = defect("splitting", "q t r r^t", "0.005"), block = defect("splitting", "q r", "0.01"),
               flows = defect("three_flows", "q t r r^t", "0.01");
  return finding(
      coarse < round_off  ? Ruling::holds
      : block < round_off ? Ruling::in_part
                          : Ruling::fails,
      "With r^t it misses by {:.1e} at h = 0.01 and {:.1e} at half of it, a defect of order {:.1f}; its (q, "
      "r) block and the composition of the three flows miss by round-off ({:.0e}, {:.0e}).",
      coarse, fine, std::log2(coarse / fine), block, flows);
}

/// Largest usable step: h, NaN where none was found.
Finding inverse_energy_error(const Results& data) {
  Cases cases;
  std::string beyond;
  for (const Row& row : data.rows("extreme_eccentricity", {{"monitor", "inverse_energy_error"}})) {
    cases.add(std::isnan(row.number("h")));
    beyond = row.text("beyond") == "non_finite" ? "not finite" : row.text("beyond");
  }
  return finding(
      in_cases(cases),
      "Its bounded form has no usable step at {} of {} eccentricities: the run ends as {}. On the solution "
      "it tends to a constant and is not differentiable; as printed it is infinity over infinity there.",
      cases.holding, cases.all, beyond);
}

Finding rate_bound(const Results& data) {
  Cases cases;
  double fitted = 0.0;
  for (const Row& row : data.rows("convergence_rate")) {
    cases.add(row.number("largest_ratio") <= 1.0, row.number("largest_ratio"));
    fitted = row.number("fitted_rate") / row.number("p");
  }
  return finding(theorem(cases),
                 "For {} orders p the largest ratio of f - f* to its bound is {:.5f}; on this quartic the "
                 "exponent of time with which it falls is {:.2f} times p.",
                 cases.all, cases.most, fitted);
}

/// Two things are said. That the dynamics of order p are integrated, in physical time, is so by construction;
/// that they have the order p_ring in fictive time is measured.
Finding adaptive_has_lower_order(const Results& data) {
  Cases cases;
  for (const Row& row : data.rows("order_equivalence", {{"clock", "exact"}}))
    cases.add(row.number("distance_100") >= 1e-10, row.number("distance_100"));
  return finding(in_cases(cases) == Ruling::holds ? Ruling::holds : Ruling::in_part,
                 "In physical time the order is p, by construction. In fictive time it is not p_ring: with "
                 "the exact clock the iterates are those of the Direct approach of the higher order "
                 "p^2/p_ring in {} of {} settings (distance below {:.0e} over the first 100 iterations).",
                 cases.all - cases.holding, cases.all, cases.most);
}

}  // namespace

Decisions structure_decisions() {
  return {{"low_eccentricity", low_eccentricity},
          {"symplectic_adaptivity", symplectic_adaptivity},
          {"splitting_is_symplectic", splitting_is_symplectic},
          {"inverse_energy_error", inverse_energy_error},
          {"rate_bound", rate_bound},
          {"adaptive_has_lower_order", adaptive_has_lower_order}};
}

}  // namespace scorecard
