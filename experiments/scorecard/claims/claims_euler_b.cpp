#include "scorecard/claims/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Claims of Section 3.3 on symplectic Euler-B and its monitors.

namespace scorecard {
namespace {

/// Steps (or seconds) of a monitor at a target of energy error, NaN where it did not run.
double euler_b(const Results& data, const char* target, const char* monitor, const char* column = "steps") {
  try {
    return data.number("euler_b_cost", {{"monitor", monitor}, {"target", target}}, column);
  } catch (const std::out_of_range&) {
    return std::nan("");
  }
}
constexpr std::array targets{"0.01", "0.001", "0.0001", "1e-05"};

/// Calls visit(target) for those at which every listed monitor ran; returns how often.
template <std::size_t n, class Visit>
std::size_t at_common_targets(const Results& data, const std::array<const char*, n>& monitors, Visit visit) {
  std::size_t cases = 0;
  for (const char* target : targets) {
    bool all = true;
    for (const char* monitor : monitors)
      all = all && std::isfinite(euler_b(data, target, monitor));
    if (!all) continue;
    ++cases;
    visit(target);
  }
  return cases;
}

Finding euler_b_costs_most(const Results& data) {
  std::size_t holding = 0;
  std::string ratios;
  const std::array monitors{"none", "truncation", "arclength", "norm_squared"};
  const auto cases = at_common_targets(data, monitors, [&](const char* target) {
    bool most = true;
    for (std::size_t m = 1; m < monitors.size(); ++m)
      for (const char* column : {"steps", "seconds"})
        most = most && euler_b(data, target, "none", column) > euler_b(data, target, monitors[m], column);
    holding += most;
    ratios +=
        fmt::format("{}{:.1f} times the steps of q.q at an energy error of {}", ratios.empty() ? "" : ", ",
                    euler_b(data, target, "none") / euler_b(data, target, "norm_squared"), target);
  });
  return {in_cases(holding, cases), ratios + ", and more time."};
}

/// Steps in number and in length: at equal energy error the two are one statement.
Finding truncation_fewest_steps(const Results& data) {
  double over_others = 0.0, over_same = 0.0;
  const auto cases =
      at_common_targets(data, std::array{"truncation", "arclength", "norm_squared"}, [&](const char* target) {
        const double steps = euler_b(data, target, "truncation");
        over_others = std::max(over_others, steps / euler_b(data, target, "arclength"));
        over_same = std::max(over_same, std::abs(steps / euler_b(data, target, "norm_squared") - 1.0));
      });
  const auto largest = [&](const char* monitor) {
    return data.number("euler_b_step_sizes", {{"monitor", monitor}}, "max_step");
  };
  const bool before_arclength = over_others < 1.0 && largest("truncation") > largest("arclength");
  const bool before_norm = over_same > 0.05;
  return {
      in_cases((before_arclength ? cases : 0) + (before_norm ? cases : 0), 2 * cases),
      fmt::format("{:.3f} of arclength's steps, the largest {:.2f} times as long, but as many as q.q {}: on "
                  "Kepler's problem |grad V| = 1/|q|^2 and the two monitors are one.",
                  over_others, largest("truncation") / largest("arclength"),
                  over_same > 0.0 ? fmt::format("to {:.0e}", over_same) : "at every error")};
}

/// How likely chance alone is to give `wins` heads or more in `tosses`.
double chance_of(int wins, int tosses) {
  double tail = 0.0;
  for (int k = wins; k <= tosses; ++k)
    tail += std::exp(std::lgamma(tosses + 1.0) - std::lgamma(k + 1.0) - std::lgamma(tosses - k + 1.0) -
                     tosses * std::log(2.0));
  return tail;
}

/// Two monitors by time at an energy error of 1e-3: steps times the time of a step, of which the data have
/// rounds in which every monitor runs once.
struct Race {
  double ratio;   ///< least time of the second over that of the first
  int wins, all;  ///< rounds that the first won
  /// A sign test over the rounds, one-sided at one per cent.
  [[nodiscard]] bool first_is_faster() const { return chance_of(wins, all) < 0.01; }
  [[nodiscard]] bool decided() const { return first_is_faster() || chance_of(all - wins, all) < 0.01; }
};

Race race(const Results& data, const char* first, const char* second) {
  const experiment::Table& rounds = data("euler_b_cost_rounds");
  const auto times = [&](const char* monitor) {
    std::map<int, double> found;
    for (std::size_t i = 0; i < rounds.rows.size(); ++i)
      if (rounds.text(i, "monitor") == monitor)
        found[static_cast<int>(rounds.number(i, "round"))] =
            euler_b(data, "0.001", monitor) * rounds.number(i, "nanoseconds");
    return found;
  };
  Race result{0.0, 0, 0};
  double least = 1e99, least_second = 1e99;
  const auto others = times(second);
  for (const auto& [round, time] : times(first)) {
    const double other = others.at(round);
    ++result.all;
    result.wins += time < other;
    least = std::min(least, time);
    least_second = std::min(least_second, other);
  }
  result.ratio = least_second / least;
  return result;
}

const char* shown(std::string_view monitor) {
  return monitor == "norm_squared" ? "q.q" : monitor == "truncation" ? "truncation error" : "arclength";
}

/// Left undecided where the rounds do not speak.
Finding norm_squared_fastest(const Results& data) {
  std::size_t holding = 0;
  bool decided = true;
  std::string seen;
  for (const auto& [faster, slower] : {std::pair{"norm_squared", "truncation"},
                                       {"norm_squared", "arclength"},
                                       {"truncation", "arclength"}}) {
    const Race found = race(data, faster, slower);
    holding += found.first_is_faster();
    decided = decided && found.decided();
    seen += fmt::format("{}{} takes {:.2f} times as long as {} (longer in {} of {} rounds)",
                        seen.empty() ? "" : ", ", shown(slower), found.ratio, shown(faster), found.wins,
                        found.all);
  }
  return {decided ? in_cases(holding, 3) : Ruling::undecided,
          "At an energy error of 1e-3 " + seen + "; a sign test at 1 % decides."};
}

Finding arclength_costs_most(const Results& data) {
  std::size_t holding = 0, slower = 0;
  std::string seen;
  const auto cases =
      at_common_targets(data, std::array{"truncation", "arclength", "norm_squared"}, [&](const char* target) {
        const double ratio = euler_b(data, target, "arclength") / euler_b(data, target, "norm_squared");
        holding += ratio > 1.02;
        seen =
            fmt::format("{:.3f} times the steps of the other two at an energy error of {}, and longer than",
                        ratio, target);
      });
  const std::array others{"norm_squared", "truncation"};
  for (const char* other : others) {
    const Race found = race(data, other, "arclength");
    slower += found.first_is_faster();
    seen += fmt::format(" {} in {} of {} rounds{}", shown(other), found.wins, found.all,
                        other == others.back() ? " at 1e-3." : ",");
  }
  return {in_cases(holding + slower, cases + others.size()), seen};
}

Finding fourth_root(const Results& data) {
  double most = 0.0;
  const auto cases =
      at_common_targets(data, std::array{"truncation", "truncation_root"}, [&](const char* target) {
        most = std::max(most, euler_b(data, target, "truncation_root") / euler_b(data, target, "truncation"));
      });
  return {in_cases(most < 1.1 ? cases : 0, cases),
          fmt::format("With the root up to {:.1f} times the steps at equal energy error.", most)};
}

/// The step is h g = (2 tol / h) |q|^2, so the error is proportional to tol / h.
Finding error_comparable_to_tol(const Results& data) {
  double least = 1e9, most = 0.0;
  const auto cases = at_common_targets(data, std::array{"truncation"}, [&](const char* target) {
    const double scaled = euler_b(data, target, "truncation", "energy_error") *
                          euler_b(data, target, "truncation", "h") /
                          euler_b(data, target, "truncation", "tol");
    least = std::min(least, scaled);
    most = std::max(most, scaled);
  });
  if (cases == 0) return {Ruling::missing, "No run with this monitor."};
  return {Ruling::undecided,
          fmt::format(
              "The error is {:.2f} to {:.2f} times tol / h, h the fictive step: comparable to tol for h near "
              "{:.0f}; the source does not give its h.",
              least, most, most)};
}

/// Times of the largest and least steps, within the resolution of the thinned curve.
Finding steps_change_together(const Results& data) {
  const experiment::Table& curve = data("euler_b_step_sizes_curve");
  std::map<std::string, std::pair<double, double>>
      extreme;  // smallest step, its time after the first quarter
  for (std::size_t i = 0; i < curve.rows.size(); ++i) {
    const double t = curve.number(i, "t"), step = curve.number(i, "step");
    if (t < 1.0) continue;  // the start is a pericentre too
    auto& [smallest, at] = extreme.try_emplace(curve.text(i, "monitor"), 1e9, 0.0).first->second;
    if (step < smallest) smallest = step, at = t;
  }
  double first = 1e9, last = 0.0;
  for (const auto& [monitor, found] : extreme)
    first = std::min(first, std::fmod(found.second, 2.0 * M_PI)),
    last = std::max(last, std::fmod(found.second, 2.0 * M_PI));
  const double apart = std::min(last - first, 2.0 * M_PI - (last - first));
  return {
      in_cases(apart < 0.05 ? extreme.size() : 0, extreme.size()),
      fmt::format("The smallest steps of all {} monitors are at the pericentre, within {:.3f} of a period of "
                  "each other.",
                  extreme.size(), std::max(1.0, std::ceil(1e3 * apart / (2.0 * M_PI))) / 1e3)};
}

}  // namespace

const Decisions& euler_b_decisions() {
  static const Decisions decisions{
      {"euler_b_costs_most", euler_b_costs_most},      {"truncation_fewest_steps", truncation_fewest_steps},
      {"norm_squared_fastest", norm_squared_fastest},  {"arclength_costs_most", arclength_costs_most},
      {"fourth_root_changes_little", fourth_root},     {"error_comparable_to_tol", error_comparable_to_tol},
      {"steps_change_together", steps_change_together}};
  return decisions;
}

}  // namespace scorecard
