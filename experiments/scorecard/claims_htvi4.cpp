#include "scorecard/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Claims of Sections 2.2 and 3.3 on HTVI: the order theorem, Tables 1 and 2.

namespace scorecard {
namespace {

/// Every cell of the order experiment, but for those whose slope could not be measured.
Finding order_theorem(const Results& data) {
  const avi::Table& table = data("order_verification");
  std::size_t cells = 0, holding = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double over = table.number(i, "measured_order") - table.number(i, "expected_order");
    if (std::isnan(over)) continue;
    ++cells;
    holding += over > -0.35;
    least = std::min(least, over);
  }
  return {in_cases(holding, cells),
          fmt::format("In {} of {} measured cells (problem, type, r, rule, construction); the least slope is "
                      "{:.2f} below the bound.",
                      holding, cells, -least)};
}

Finding htvi4_order(const Results& data) {
  const avi::Table& table = data("order_verification");
  std::size_t cells = 0, holding = 0;
  double least = 1e9, most = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.text(i, "r") != "3" || table.text(i, "quadrature") != "simpson" ||
        table.text(i, "construction") != "printed" || std::isnan(table.number(i, "measured_order")))
      continue;
    const double order = table.number(i, "measured_order");
    ++cells;
    holding += std::abs(order - 4.0) < 0.35;
    least = std::min(least, order);
    most = std::max(most, order);
  }
  return {in_cases(holding, cells),
          fmt::format("Measured slopes {:.2f} to {:.2f} on {} problems and types.", least, most, cells)};
}

constexpr std::array tables{"kepler_e090", "kepler_e099"};

double htvi4(const Results& data, const std::string& stem, const char* monitor, std::string_view column) {
  return data.number(stem, {{"method", "htvi4"}, {"construction", "authors"}, {"monitor", monitor}}, column);
}
double verlet(const Results& data, const std::string& stem, std::string_view column) {
  return data.number(stem, {{"method", "stormer_verlet"}}, column);
}

Finding arclength_behind(const Results& data) {
  std::size_t holding = 0, cases = 0;
  std::string steps;
  for (const char* stem : tables) {
    for (const char* monitor : {"gamma", "energy"})
      for (const char* column : {"steps", "global_error", "seconds"}) {
        ++cases;
        holding += htvi4(data, stem, monitor, column) < htvi4(data, stem, "arclength", column);
      }
    steps += fmt::format("{}{:.0f} and {:.0f} steps against {:.0f}", steps.empty() ? "" : ", ",
                         htvi4(data, stem, "energy", "steps"), htvi4(data, stem, "gamma", "steps"),
                         htvi4(data, stem, "arclength", "steps"));
  }
  return {in_cases(holding, cases), steps + ", smaller errors and times in both tables."};
}

Finding energy_not_extreme(const Results& data) {
  std::size_t holding = 0;
  std::string seen;
  for (const char* stem : tables) {
    const double least = htvi4(data, stem, "energy", "min_step"),
                 most = htvi4(data, stem, "energy", "max_step");
    bool smallest = true, largest = true;
    for (const char* monitor : {"gamma", "arclength"}) {
      smallest = smallest && least < htvi4(data, stem, monitor, "min_step");
      largest = largest && most > htvi4(data, stem, monitor, "max_step");
    }
    holding += !smallest && !largest;
    seen += fmt::format("{}steps {:.5f} to {:.4f}", seen.empty() ? "" : ", ", least, most);
  }
  return {in_cases(holding, tables.size()), seen + ", inside or above the ranges of the others."};
}

Finding gamma_most_efficient(const Results& data) {
  std::size_t fewest = 0, most_accurate = 0;
  std::string seen;
  for (const char* stem : tables) {
    const auto ratio = [&](const char* column) {
      return htvi4(data, stem, "energy", column) / htvi4(data, stem, "gamma", column);
    };
    fewest += ratio("steps") > 1.0;
    most_accurate += ratio("global_error") > 1.0;
    seen += fmt::format(
        "{}energy takes {:.2f} times gamma's steps and {:.2f} times its time for {:.2f} times its error",
        seen.empty() ? "" : "; ", ratio("steps"), ratio("seconds"), ratio("global_error"));
  }
  return {in_cases(fewest + most_accurate, 2 * tables.size()), seen + "."};
}

Finding gradient_free_is_cheaper(const Results& data) {
  std::size_t holding = 0;
  std::string seen;
  for (const char* stem : tables) {
    const auto per_step = [&](const char* monitor) {
      return htvi4(data, stem, monitor, "seconds") / htvi4(data, stem, monitor, "steps");
    };
    const double ratio = per_step("arclength") / per_step("gamma");
    holding += ratio > 1.2;
    seen += fmt::format("{}{:.2f}", seen.empty() ? "" : " and ", ratio);
  }
  return {holding == tables.size() ? Ruling::holds : Ruling::undecided,
          "A step with arclength takes " + seen + " times as long as one with gamma."};
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

Finding adaptivity_pays(const Results& data) {
  std::size_t holding = 0, cases = 0;
  std::string seen;
  for (const char* stem : tables) {
    for (const char* monitor : {"gamma", "energy", "arclength"}) {
      ++cases;
      holding += htvi4(data, stem, monitor, "seconds") <
                 std::min(htvi4(data, stem, "none", "seconds"), verlet(data, stem, "seconds"));
    }
    seen += fmt::format("{}gamma takes 1/{:.1f} of fixed HTVI4's time and 1/{:.0f} of Stormer-Verlet's",
                        seen.empty() ? "" : "; ",
                        htvi4(data, stem, "none", "seconds") / htvi4(data, stem, "gamma", "seconds"),
                        verlet(data, stem, "seconds") / htvi4(data, stem, "gamma", "seconds"));
  }
  return {in_cases(holding, cases), seen + ". (The paper's own seconds say so only of Table 2.)"};
}

}  // namespace

const Decisions& htvi_decisions() {
  static const Decisions decisions{{"order_theorem", order_theorem},
                                   {"htvi4_is_fourth_order", htvi4_order},
                                   {"arclength_behind", arclength_behind},
                                   {"energy_not_extreme", energy_not_extreme},
                                   {"gamma_most_efficient", gamma_most_efficient},
                                   {"gradient_free_is_cheaper", gradient_free_is_cheaper},
                                   {"bound_holds_for_steps", bound_holds},
                                   {"adaptivity_pays", adaptivity_pays}};
  return decisions;
}

}  // namespace scorecard
