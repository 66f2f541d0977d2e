#include "scorecard/claims/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Claims of Sections 2.2 and 3.3 on HTVI: the order theorem, Tables 1 and 2.

namespace scorecard {
namespace {

/// What a slope over four steps may miss the order by.
constexpr double order_tolerance = 0.35;

/// Every cell of the construction as printed, but for those whose slope could not be measured. A slope that
/// is short is judged by what it extrapolates to at h = 0: it comes from below where two terms of the error
/// cancel at one of the steps, while that of a lower order does not rise.
Finding order_theorem(const Results& data) {
  const experiment::Table& table = data("order_verification");
  std::size_t cells = 0, holding = 0, rising = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double expected = table.number(i, "expected_order");
    const double over = table.number(i, "measured_order") - expected;
    if (std::isnan(over) || table.text(i, "construction") != "printed") continue;
    ++cells;
    const bool enough = over > -order_tolerance;
    const bool rises = !enough && table.number(i, "limit_order") - expected > -order_tolerance;
    holding += enough || rises;
    rising += rises;
    least = std::min(least, over);
  }
  return {
      theorem(holding, cells),
      fmt::format(
          "In {} of {} measured cells (problem, type, r, rule); the least slope is {:.2f} below the bound. "
          "{} of the slopes are short at the steps used but rise to the bound as h falls, where two terms "
          "of the error cancel.",
          holding, cells, -least, rising)};
}

Finding htvi4_order(const Results& data) {
  const experiment::Table& table = data("order_verification");
  std::size_t cells = 0, holding = 0;
  double least = 1e9, most = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.text(i, "r") != "3" || table.text(i, "quadrature") != "simpson" ||
        table.text(i, "construction") != "printed" || std::isnan(table.number(i, "measured_order")))
      continue;
    const double order = table.number(i, "measured_order");
    ++cells;
    holding += std::abs(order - 4.0) < order_tolerance;
    least = std::min(least, order);
    most = std::max(most, order);
  }
  return {theorem(holding, cells),
          fmt::format("Measured slopes {:.2f} to {:.2f} on {} problems and types.", least, most, cells)};
}

constexpr std::array tables{"kepler_e090", "kepler_e099"};

double htvi4(const Results& data, const std::string& stem, const char* monitor, std::string_view column) {
  return data.number(stem, {{"method", "htvi4"}, {"construction", "authors"}, {"monitor", monitor}}, column);
}
double verlet(const Results& data, const std::string& stem, std::string_view column) {
  return data.number(stem, {{"method", "stormer_verlet"}}, column);
}

/// Calls visit(number of) for each eccentricity and energy error that monitor_costs has, where number
/// of(monitor, column) is its cell.
template <class Visit>
std::size_t at_matched_error(const Results& data, Visit visit) {
  std::size_t cases = 0;
  for (const char* eccentricity : {"0.9", "0.99"})
    for (const char* target : {"1e-5", "1e-7"}) {
      const auto of = [&](const char* monitor, const char* column) {
        return data.number("monitor_costs",
                           {{"eccentricity", eccentricity}, {"target", target}, {"monitor", monitor}},
                           column);
      };
      try {
        of("gamma", "h");
      } catch (const std::out_of_range&) {
        continue;  // a shortened run
      }
      ++cases;
      visit(of);
    }
  return cases;
}

Finding arclength_behind(const Results& data) {
  std::size_t holding = 0, comparisons = 0;
  double least = 1e9;
  at_matched_error(data, [&](auto of) {
    for (const char* monitor : {"gamma", "energy"})
      for (const char* column : {"steps_per_orbit", "seconds", "position_error"}) {
        ++comparisons;
        holding += of(monitor, column) < of("arclength", column);
        least = std::min(least, of("arclength", column) / of(monitor, column));
      }
  });
  return {
      in_cases(holding, comparisons),
      fmt::format(
          "At equal energy error arclength takes more steps and time for a larger position error in {} of "
          "{} comparisons, by a factor of {:.2f} at least.",
          holding, comparisons, least)};
}

Finding energy_not_extreme(const Results& data) {
  std::size_t holding = 0;
  std::string seen;
  for (const char* stem : tables) {
    const double least = htvi4(data, stem, "energy", "min_step"),
                 most = htvi4(data, stem, "energy", "max_step");
    double smallest = least, largest = most;
    for (const char* monitor : {"gamma", "arclength"}) {
      smallest = std::min(smallest, htvi4(data, stem, monitor, "min_step"));
      largest = std::max(largest, htvi4(data, stem, monitor, "max_step"));
    }
    holding += smallest < least && most < largest;
    seen += fmt::format("{}steps from {:.5f} to {:.4f} where those of all three go from {:.5f} to {:.4f}",
                        seen.empty() ? "Tables 1 and 2: " : ", and ", least, most, smallest, largest);
  }
  return {in_cases(holding, tables.size()), seen + "."};
}

/// Efficiency is steps and time, each at equal error. "Very close" leaves 20 per cent.
Finding gamma_most_efficient(const Results& data) {
  std::size_t first = 0, close = 0, cases = 0;
  const auto compared = [&](const char* column) {
    double least = 1e9, most = 0.0;
    cases += at_matched_error(data, [&](auto of) {
      const double ratio = of("gamma", column) / of("energy", column);
      first += ratio < 1.0;
      close += ratio > 1.0 / 1.2 && ratio < 1.2;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    });
    return std::pair{least, most};
  };
  const auto [least_steps, most_steps] = compared("steps_per_orbit");
  const auto [least_time, most_time] = compared("seconds");
  return {in_cases(first + close, 2 * cases),
          fmt::format("At equal energy error gamma = 1 takes {:.1f} to {:.1f} times the steps of the energy "
                      "monitor and {:.1f} to {:.1f} times its time.",
                      least_steps, most_steps, least_time, most_time)};
}

Finding gradient_free_is_cheaper(const Results& data) {
  std::size_t holding = 0;
  double least = 1e9, most = 0.0;
  const auto cases = at_matched_error(data, [&](auto of) {
    const double ratio = of("arclength", "seconds") / of("gamma", "seconds");
    holding += ratio > 1.2;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  });
  return {holding == cases ? Ruling::holds : Ruling::undecided,
          fmt::format("At equal energy error arclength takes {:.1f} to {:.1f} times as long.", least, most)};
}

/// "Decent" is at most twice the steps of gamma, "noticeable" at least ten per cent.
Finding inverse_lagrangian(const Results& data) {
  std::size_t decent = 0, improved = 0;
  double least = 1e9, most = 0.0;
  const auto cases = at_matched_error(data, [&](auto of) {
    const double ratio = of("inverse_lagrangian", "steps_per_orbit") / of("energy", "steps_per_orbit");
    decent += of("inverse_lagrangian", "steps_per_orbit") < 2.0 * of("gamma", "steps_per_orbit");
    improved += ratio > 1.1;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  });
  return {
      in_cases(decent + improved, 2 * cases),
      fmt::format(
          "At equal energy error |L|^-1 takes {:.1f} to {:.1f} times the steps of the energy monitor, and "
          "in {} of {} cases fewer than twice those of gamma.",
          least, most, decent, cases)};
}

Finding bound_holds(const Results& data) {
  std::size_t holding = 0, cases = 0;
  double nearest = 1e9;
  for (const char* stem : tables)
    for (const char* monitor : {"gamma", "energy", "arclength"}) {
      const double h = htvi4(data, stem, monitor, "h");
      const double low = htvi4(data, stem, monitor, "min_step") / (h * htvi4(data, stem, monitor, "g_min"));
      const double high = htvi4(data, stem, monitor, "max_step") / (h * htvi4(data, stem, monitor, "g_max"));
      ++cases;
      holding += low >= 1.0 && high <= 1.0;
      nearest = std::min(nearest, low);
    }
  return {
      in_cases(holding, cases),
      fmt::format("Every step of six runs lies between a h and b h; the smallest is {:.2f} a h.", nearest)};
}

/// Stormer-Verlet's step is scaled to the energy error of each adaptive run by its order, two; fixed HTVI4 is
/// measured at that error.
Finding adaptivity_pays(const Results& data) {
  std::size_t holding = 0, cases = 0;
  std::string seen;
  for (const char* stem : tables) {
    for (const char* monitor : {"gamma", "energy", "arclength"}) {
      const double same_error =
          std::sqrt(verlet(data, stem, "energy_error") / htvi4(data, stem, monitor, "energy_error"));
      const double ratio = verlet(data, stem, "seconds") * same_error / htvi4(data, stem, monitor, "seconds");
      ++cases;
      holding += ratio > 1.0;
      if (std::string_view(monitor) == "gamma")
        seen += fmt::format("{}{:.0f}", seen.empty() ? "" : " and ", ratio);
    }
  }
  double least = 1e9;
  cases += at_matched_error(data, [&](auto of) {
    const double ratio = of("none", "seconds") / of("gamma", "seconds");
    holding += ratio > 1.0;
    least = std::min(least, ratio);
  });
  return {
      in_cases(holding, cases),
      fmt::format("The source's own Table 1 says the opposite of Stormer-Verlet (26.9 against 1.9 seconds). "
                  "Compiled and at equal energy error, gamma is {} times faster than it, and at least {:.1f} "
                  "times faster than fixed HTVI4.",
                  seen, least)};
}

}  // namespace

const Decisions& htvi_decisions() {
  static const Decisions decisions{{"order_theorem", order_theorem},
                                   {"htvi4_is_fourth_order", htvi4_order},
                                   {"arclength_behind", arclength_behind},
                                   {"energy_not_extreme", energy_not_extreme},
                                   {"gamma_most_efficient", gamma_most_efficient},
                                   {"inverse_lagrangian", inverse_lagrangian},
                                   {"gradient_free_is_cheaper", gradient_free_is_cheaper},
                                   {"bound_holds_for_steps", bound_holds},
                                   {"adaptivity_pays", adaptivity_pays}};
  return decisions;
}

}  // namespace scorecard
