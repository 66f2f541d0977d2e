#include "scorecard/claims/claims.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>

// Claims of Section 3.3 on symplectic Euler-B and its monitors.

namespace scorecard {
namespace {

/// The runs at each target of energy error that all these monitors reached.
std::vector<Comparison> at_targets(const Results& data, std::initializer_list<std::string_view> monitors) {
  return comparisons(data("euler_b_cost"), {"target"}, monitors);
}

Finding euler_b_costs_most(const Results& data) {
  const auto all = at_targets(data, {"none", "truncation", "arclength", "norm_squared"});
  Cases cases;
  for (const char* monitor : {"truncation", "arclength", "norm_squared"})
    for (const char* column : {"steps", "seconds"})
      cases = cases + more_than(1.0, all, column, "none", monitor);
  Cases of_norm, of_arclength;
  for (const Comparison& at : all) {
    of_norm.add(true, at.ratio("steps", "none", "norm_squared"));
    of_arclength.add(true, at.ratio("steps", "none", "arclength"));
  }
  return finding(in_cases(cases),
                 "{:.1f} to {:.1f} times the steps of q.q and {:.1f} to {:.1f} times those of arclength at "
                 "energy errors of 1e-2 to 1e-4, and more time.",
                 of_norm.least, of_norm.most, of_arclength.least, of_arclength.most);
}

/// Steps in number and in length: at equal energy error the two are one statement.
Finding truncation_fewest_steps(const Results& data) {
  const auto largest = [&](const char* monitor) {
    return data.number("euler_b_step_sizes", {{"monitor", monitor}}, "max_step");
  };
  const double length = largest("truncation") / largest("arclength");
  Cases cases;
  double apart = 0.0;
  for (const Comparison& at : at_targets(data, {"truncation", "arclength", "norm_squared"})) {
    const double steps = at.ratio("steps", "truncation", "arclength");
    const double off = std::abs(at.ratio("steps", "truncation", "norm_squared") - 1.0);
    cases.add(steps < 1.0 && length > 1.0, steps);
    cases.add(off > 0.05);
    apart = std::max(apart, off);
  }
  return finding(in_cases(cases),
                 "{:.3f} of arclength's steps, the largest {:.2f} times as long, but as many as q.q {}: on "
                 "Kepler's problem |grad V| = 1/|q|^2 and the two monitors are one.",
                 cases.most, length, apart > 0.0 ? fmt::format("to {:.0e}", apart) : "at every error");
}

/// Two monitors by time at an energy error of 1e-3: steps times the time of a step, of which the data have
/// rounds in which every monitor runs once.
struct Race {
  double ratio;        ///< least time of the second over that of the first
  unsigned wins, all;  ///< rounds that the first won
  /// A sign test over the rounds, one-sided at one per cent.
  [[nodiscard]] bool first_is_faster() const { return gsl_cdf_binomial_P(all - wins, 0.5, all) < 0.01; }
  [[nodiscard]] bool decided() const {
    return first_is_faster() || gsl_cdf_binomial_P(wins, 0.5, all) < 0.01;
  }
};

Race race(const Results& data, const char* first, const char* second) {
  const auto times = [&](const char* monitor) {
    const double steps = data.number("euler_b_cost", {{"monitor", monitor}, {"target", "1e-3"}}, "steps");
    std::vector<double> found;
    for (const Row& round : data.rows("euler_b_cost_rounds", {{"monitor", monitor}}))
      found.push_back(steps * round.number("nanoseconds"));
    return found;
  };
  const auto ours = times(first), others = times(second);
  Race result{std::ranges::min(others) / std::ranges::min(ours), 0, static_cast<unsigned>(ours.size())};
  for (std::size_t round = 0; round < ours.size(); ++round)
    result.wins += ours[round] < others.at(round);
  return result;
}

const char* shown(std::string_view monitor) {
  return monitor == "norm_squared" ? "q.q" : monitor == "truncation" ? "truncation error" : "arclength";
}

/// Left undecided where the rounds do not speak.
Finding norm_squared_fastest(const Results& data) {
  Cases cases;
  bool decided = true;
  std::vector<std::string> seen;
  for (const auto& [faster, slower] : {std::pair{"norm_squared", "truncation"},
                                       {"norm_squared", "arclength"},
                                       {"truncation", "arclength"}}) {
    const Race found = race(data, faster, slower);
    cases.add(found.first_is_faster());
    decided = decided && found.decided();
    seen.push_back(fmt::format("{} takes {:.2f} times as long as {} (longer in {} of {} rounds)",
                               shown(slower), found.ratio, shown(faster), found.wins, found.all));
  }
  return finding(decided ? in_cases(cases) : Ruling::undecided,
                 "At an energy error of 1e-3, by the least time of the rounds, {}; a sign test over the "
                 "rounds at 1 % decides. The first two are one monitor (claim 5): the factor between them is "
                 "the price of its two formulas in our code.",
                 fmt::join(seen, ", "));
}

Finding arclength_costs_most(const Results& data) {
  const auto all = at_targets(data, {"truncation", "arclength", "norm_squared"});
  Cases cases = more_than(1.02, all, "steps", "arclength", "norm_squared");
  std::vector<std::string> longer;
  for (const char* other : {"norm_squared", "truncation"}) {
    const Race found = race(data, other, "arclength");
    cases.add(found.first_is_faster());
    longer.push_back(fmt::format("{} in {} of {} rounds", shown(other), found.wins, found.all));
  }
  return finding(in_cases(cases),
                 "{:.3f} times the steps of the other two at an energy error of {}, and longer than {} at "
                 "1e-3, in our code.",
                 all.back().ratio("steps", "arclength", "norm_squared"), all.back()("arclength", "target"),
                 fmt::join(longer, ", "));
}

Finding fourth_root(const Results& data) {
  Cases cases;
  for (const Comparison& at : at_targets(data, {"truncation", "truncation_root"})) {
    const double more = at.ratio("steps", "truncation_root", "truncation");
    cases.add(more < 1.1, more);
  }
  return finding(in_cases(cases), "With the root up to {:.1f} times the steps at equal energy error.",
                 cases.most);
}

/// The step is h g = (2 tol / h) |q|^2, so the error is proportional to tol / h.
Finding error_comparable_to_tol(const Results& data) {
  Cases cases;
  for (const Row& row : data.rows("euler_b_cost", {{"monitor", "truncation"}}))
    cases.add(true, row.number("energy_error") * row.number("h") / row.number("tol"));
  (void)in_cases(cases);  // throws where there is none
  return finding(Ruling::undecided,
                 "The error is {:.2f} to {:.2f} times tol / h, h the fictive step: comparable to tol for h "
                 "near {:.0f}; the source does not give its h.",
                 cases.least, cases.most, cases.most);
}

/// Times of the smallest steps, within the resolution of the thinned curve.
Finding steps_change_together(const Results& data) {
  std::map<std::string, std::pair<double, double>> smallest;  // by monitor: the step and when in its period
  for (const Row& row : data.rows("euler_b_step_sizes_curve")) {
    if (row.number("t") < 1.0) continue;  // the start is a pericentre too
    const std::pair now{row.number("step"), std::fmod(row.number("t"), 2.0 * M_PI)};
    auto& least = smallest.try_emplace(row.text("monitor"), now).first->second;
    if (now.first < least.first) least = now;
  }
  Cases times;
  for (const auto& [monitor, step_and_time] : smallest)
    times.add(true, step_and_time.second);
  const double apart = std::min(times.most - times.least, 2.0 * M_PI - (times.most - times.least));
  return finding(
      apart < 0.05 ? in_cases(times) : Ruling::fails,
      "The smallest steps of all {} monitors are at the pericentre, within {:.3f} of a period of each other.",
      times.all, std::max(1.0, std::ceil(1e3 * apart / (2.0 * M_PI))) / 1e3);
}

/// The source's runs go to T = 1000, ours not so far: the evidence says up to where.
template <Finding (*decide)(const Results&)>
Finding up_to_horizon(const Results& data) {
  Finding found = decide(data);
  found.evidence += fmt::format(" Up to T = {:g}; the source's runs go to 1000.",
                                data.rows("euler_b_cost").front().number("horizon"));
  return found;
}

}  // namespace

Decisions euler_b_decisions() {
  return {{"euler_b_costs_most", up_to_horizon<euler_b_costs_most>},
          {"truncation_fewest_steps", up_to_horizon<truncation_fewest_steps>},
          {"norm_squared_fastest", up_to_horizon<norm_squared_fastest>},
          {"arclength_costs_most", up_to_horizon<arclength_costs_most>},
          {"fourth_root_changes_little", fourth_root},
          {"error_comparable_to_tol", error_comparable_to_tol},
          {"steps_change_together", steps_change_together}};
}

}  // namespace scorecard
