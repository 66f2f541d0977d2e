#include "scorecard/claims/claims.hpp"

#include <algorithm>
#include <cmath>

// Claims on what adaptivity keeps and gains (symplecticity, eccentricity, a monitor that was discarded) and
// on the dynamics that are integrated.

namespace scorecard {
namespace {

/// Ratio of the steps of fixed HTVI4 to adaptive HTVI4 at one position error.
Finding low_eccentricity(const Results& data) {
  const experiment::Table& table = data("eccentricity_gain");
  double low = 0.0, high = 0.0, least = 1.0, most = 0.0;
  for (std::size_t i = 0; i + 1 < table.rows.size(); i += 2) {
    const double e = table.number(i, "eccentricity");
    const double gain = table.number(i, "steps") / table.number(i + 1, "steps");
    if (e < 0.25) low = std::max(low, gain);
    if (e < 0.25) most = e;
    if (e > 0.85) high = gain, least = e;
  }
  return {
      low < 1.2 && high > 3.0 ? Ruling::holds
      : high > low            ? Ruling::in_part
                              : Ruling::fails,
      fmt::format(
          "At one position error fixed HTVI4 takes at most {:.2f} times the steps of adaptive HTVI4 up to "
          "e = {:.1f}, and {:.1f} times at e = {:.1f}.",
          low, most, high, least)};
}

/// Defects of one step are round-off where they are below this; differences are good to about 1e-12.
constexpr double round_off = 2e-11;

Finding symplectic_adaptivity(const Results& data) {
  const experiment::Table& table = data("symplecticity");
  std::size_t cases = 0, holding = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.text(i, "problem") != "kepler") continue;
    ++cases;
    holding += table.number(i, "defect") < round_off;
    most = std::max(most, table.number(i, "defect"));
  }
  return {
      theorem(holding, cases),
      fmt::format("One step of HTVI4 and of Euler-B misses a symplectic map by at most {:.0e}, whatever h: "
                  "round-off.",
                  most)};
}

Finding splitting_is_symplectic(const Results& data) {
  const auto defect = [&](const char* method, const char* variables, const char* h) {
    return data.number("symplecticity", {{"method", method}, {"variables", variables}, {"h", h}}, "defect");
  };
  const double coarse = defect("splitting", "q t r r^t", "0.01"),
               fine = defect("splitting", "q t r r^t", "0.005"), block = defect("splitting", "q r", "0.01"),
               flows = defect("three_flows", "q t r r^t", "0.01");
  return {
      coarse < round_off  ? Ruling::holds
      : block < round_off ? Ruling::in_part
                          : Ruling::fails,
      fmt::format(
          "With r^t it misses by {:.1e} at h = 0.01 and {:.1e} at half of it, a defect of order {:.1f}; its "
          "(q, r) block and the composition of the three flows miss by round-off ({:.0e}, {:.0e}).",
          coarse, fine, std::log2(coarse / fine), block, flows)};
}

/// Largest usable step: h, NaN where none was found.
Finding inverse_energy_error(const Results& data) {
  const experiment::Table& table = data("extreme_eccentricity");
  std::size_t cases = 0, failing = 0;
  std::string beyond;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.text(i, "monitor") != "inverse_energy_error") continue;
    ++cases;
    failing += std::isnan(table.number(i, "h"));
    beyond = table.text(i, "beyond") == "non_finite" ? "not finite" : table.text(i, "beyond");
  }
  return {in_cases(failing, cases),
          fmt::format(
              "Its bounded form has no usable step at {} of {} eccentricities: the run ends as {}. On the "
              "solution it tends to a constant and is not differentiable; as printed it is infinity over "
              "infinity there.",
              failing, cases, beyond)};
}

Finding rate_bound(const Results& data) {
  const experiment::Table& table = data("convergence_rate");
  std::size_t holding = 0;
  double most = 0.0, fitted = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double ratio = table.number(i, "largest_ratio");
    holding += ratio <= 1.0;
    most = std::max(most, ratio);
    fitted = table.number(i, "fitted_rate") / table.number(i, "p");
  }
  return {
      theorem(holding, table.rows.size()),
      fmt::format("For {} orders p the largest ratio of f - f* to its bound is {:.5f}; on this quartic the "
                  "exponent of time with which it falls is {:.2f} times p.",
                  table.rows.size(), most, fitted)};
}

Finding adaptive_has_lower_order(const Results& data) {
  const experiment::Table& table = data("order_equivalence");
  double most = 0.0;
  std::size_t same = 0, cases = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.text(i, "clock") != "exact") continue;
    ++cases;
    most = std::max(most, table.number(i, "distance_100"));
    same += table.number(i, "distance_100") < 1e-10;
  }
  return {
      in_cases(cases - same, cases),
      fmt::format("With the exact clock its iterates are those of the Direct approach of the higher order "
                  "p^2/p_ring in {} of {} settings (distance below {:.0e} over 100 iterations).",
                  same, cases, most)};
}

}  // namespace

const Decisions& structure_decisions() {
  static const Decisions decisions{{"low_eccentricity", low_eccentricity},
                                   {"symplectic_adaptivity", symplectic_adaptivity},
                                   {"splitting_is_symplectic", splitting_is_symplectic},
                                   {"inverse_energy_error", inverse_energy_error},
                                   {"rate_bound", rate_bound},
                                   {"adaptive_has_lower_order", adaptive_has_lower_order}};
  return decisions;
}

}  // namespace scorecard
