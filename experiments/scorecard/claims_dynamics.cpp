#include "scorecard/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Claims of Sections 4.2 to 4.5.3: Bregman dynamics, Direct and Adaptive, by symplectic methods.

namespace scorecard {
namespace {

/// One converged row of an iteration table.
struct Row {
  std::string method;
  bool adaptive;
  double p, p_ring, h, iterations, gradients;

  /// Physical time at the end: t^s = 1 + n h, s = p_ring / p.
  [[nodiscard]] double t_end() const {
    return adaptive ? std::pow(1.0 + iterations * h, p / p_ring) : 1.0 + iterations * h;
  }
  /// Physical step at time t.
  [[nodiscard]] double physical_step(double t) const {
    return adaptive ? h * p / p_ring * std::pow(t, 1.0 - p_ring / p) : h;
  }
  [[nodiscard]] double mean_step() const { return (t_end() - 1.0) / iterations; }
};

std::vector<Row> rows_of(const avi::Table& table) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "converged") == "1")
      rows.push_back({table.text(i, "method"), table.text(i, "approach") == "adaptive", table.number(i, "p"),
                      table.number(i, "p_ring"), table.number(i, "h"), table.number(i, "iterations"),
                      table.number(i, "gradient_evaluations")});
  return rows;
}

/// Calls visit(direct, adaptive) for every pair of rows with the same method and p; returns how many.
template <class Visit>
std::size_t pairs(const std::vector<Row>& rows, Visit visit) {
  std::size_t count = 0;
  for (const Row& d : rows)
    for (const Row& a : rows)
      if (!d.adaptive && a.adaptive && d.method == a.method && d.p == a.p) {
        visit(d, a);
        ++count;
      }
  return count;
}

Finding rate_bound(const Results& data) {
  const avi::Table& table = data("convergence_rate");
  std::size_t holding = 0;
  double most = 0.0, fitted = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double ratio = table.number(i, "largest_ratio");
    holding += ratio <= 1.0;
    most = std::max(most, ratio);
    fitted = table.number(i, "fitted_rate") / table.number(i, "p");
  }
  return {in_cases(holding, table.rows.size()),
          fmt::format("For {} orders p the largest ratio of f - f* to its bound is {:.5f}; on this quartic f "
                      "falls as t^({:.2f} p).",
                      table.rows.size(), most, fitted)};
}

Finding adaptive_has_lower_order(const Results& data) {
  const avi::Table& table = data("order_equivalence");
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

/// The last equation is printed as r~' = +grad_q~ H_2. Copies that start at one point and solve the same
/// equations stay together but for the error of the splitting, O(h^2).
Finding cloning_equations(const Results& data) {
  const avi::Table& table = data("cloning_sign");
  const std::size_t printed = table.rows.size() / 2 - 1, meant = table.rows.size() - 1;
  const bool slip = table.number(meant, "order") > 1.9 && table.number(printed, "order") < 0.1;
  return {slip ? Ruling::fails : Ruling::holds,
          fmt::format(
              "The last has a wrong sign: from h to h/2 the distance of the two copies falls with the power "
              "{:.2f} for the printed sign and {:.2f} for the other, to {:.1e} and {:.1e}. The copy that is "
              "read does not feel it.",
              std::abs(table.number(printed, "order")), table.number(meant, "order"),
              table.number(printed, "distance"), table.number(meant, "distance"))};
}

Finding adaptive_beats_direct(const Results& data) {
  std::size_t holding = 0;
  std::string seen;
  const auto cases = pairs(rows_of(data("direct_vs_adaptive")), [&](const Row& d, const Row& a) {
    holding += 2.0 * a.iterations < d.iterations;
    seen += fmt::format("{}{:.1f}", seen.empty() ? "" : ", ", d.iterations / a.iterations);
  });
  return {in_cases(holding, cases), seen + " times fewer iterations."};
}

Finding adaptive_steps_outgrow(const Results& data) {
  std::size_t holding = 0;
  std::string seen;
  const auto cases = pairs(rows_of(data("direct_vs_adaptive")), [&](const Row& d, const Row& a) {
    const double ratio = a.physical_step(a.t_end()) / d.physical_step(d.t_end());
    holding += ratio > 1.0;
    seen += fmt::format("{}{:.1f}", seen.empty() ? "" : ", ", ratio);
  });
  return {in_cases(holding, cases), "At the end they are " + seen + " times as long."};
}

Finding same_order_of_magnitude(const Results& data) {
  const auto rows = rows_of(data("method_comparison"));
  std::size_t holding = 0, cases = 0;
  std::string seen;
  for (const bool adaptive : {false, true}) {
    double least = 1e99, most = 0.0;
    for (const Row& row : rows)
      if (row.adaptive == adaptive)
        least = std::min(least, row.iterations), most = std::max(most, row.iterations);
    if (most == 0.0) continue;
    ++cases;
    holding += most < 10.0 * least;
    seen += fmt::format("{}{:.0f} to {:.0f}", seen.empty() ? "" : ", ", least, most);
  }
  return {in_cases(holding, cases), seen + " iterations."};
}

/// Gradients of an iteration less the one that only the stopping test at the new point needs.
double useful(const Row& row) { return std::round(row.gradients / row.iterations) - 1.0; }
double printed_gradients(const std::string& method) {
  return method == "clone_strang" ? 3.0 : method == "clone_y4" ? 7.0 : 19.0;
}

Finding cloning_is_behind(const Results& data) {
  const auto rows = rows_of(data("method_comparison"));
  std::size_t as_printed = 0, reduced = 0, cases = 0;
  for (const Row& row : rows) {
    if (!row.method.starts_with("clone")) continue;
    double best = 1e99;
    for (const Row& other : rows)
      if (other.adaptive == row.adaptive && !other.method.starts_with("clone"))
        best = std::max(best == 1e99 ? 0.0 : best, other.gradients);
    ++cases;
    as_printed += printed_gradients(row.method) * row.iterations > 1.5 * best;
    reduced += useful(row) * row.iterations > 1.5 * best;
  }
  return {in_cases(as_printed + reduced, 2 * cases),
          fmt::format("With the printed gradients per step in {} of {} rows; with those that the iterates "
                      "depend on in {}: Strang's cloning is then level with HTVI.",
                      as_printed, cases, reduced)};
}

Finding cloning_needs(const Results& data) {
  std::size_t needed = 0, cases = 0;
  std::map<std::string, double> counts;
  for (const Row& row : rows_of(data("method_comparison"))) {
    if (!row.method.starts_with("clone")) continue;
    ++cases;
    needed += useful(row) >= printed_gradients(row.method);
    counts[row.method] = useful(row);
  }
  std::string seen;
  for (const auto& [method, count] : counts)
    seen += fmt::format("{}{:.0f}", seen.empty() ? "" : ", ", count);
  return {in_cases(needed, cases), "The copy that is read never sees the other: the same iterates take " +
                                       seen + " gradients a step."};
}

/// Iterations along a sweep of p at p_ring = 1, or of p_ring at p = 4.
std::map<double, Row> sweep(const Results& data, bool of_p) {
  std::map<double, Row> found;
  for (const Row& row : rows_of(data("p_dependence")))
    if (of_p ? row.p_ring == 1.0 : row.p == 4.0) found.emplace(of_p ? row.p : -row.p_ring, row);
  return found;
}

Finding efficiency_grows(const Results& data) {
  std::size_t holding = 0, cases = 0;
  std::string seen;
  for (const bool of_p : {true, false}) {
    double before = 0.0;
    for (const auto& [key, row] : sweep(data, of_p)) {
      if (before > 0.0) ++cases, holding += row.iterations < before;
      before = row.iterations;
      seen += fmt::format("{}{:.0f}", seen.empty() ? "" : key == -2.0 ? "; " : ", ", row.iterations);
    }
  }
  return {in_cases(holding, cases), seen + " iterations along the two sweeps."};
}

Finding first_doubling(const Results& data) {
  const auto along = sweep(data, true);
  const double first = along.at(2.0).iterations / along.at(4.0).iterations,
               second = along.at(4.0).iterations / along.at(8.0).iterations;
  return {first > 2.0 * second && second > 1.0 ? Ruling::holds : Ruling::fails,
          fmt::format("Factors {:.1f} and {:.2f}; the order P = p^2/p_ring goes from 4 to 16 to 64.", first,
                      second)};
}

Finding physical_steps_stay(const Results& data) {
  std::size_t holding = 0;
  std::string seen;
  for (const bool of_p : {true, false}) {
    const auto along = sweep(data, of_p);
    const double ratio = along.rbegin()->second.mean_step() / along.begin()->second.mean_step();
    holding += ratio > 0.5;
    seen += fmt::format("{}by a factor {:.2g} as {}", seen.empty() ? "" : ", ", ratio,
                        of_p ? "p goes from 2 to 8" : "p_ring from 2 to 0.1");
  }
  return {in_cases(holding, 2), "The mean physical step changes " + seen + "."};
}

}  // namespace

const Decisions& dynamics_decisions() {
  static const Decisions decisions{{"rate_bound", rate_bound},
                                   {"adaptive_has_lower_order", adaptive_has_lower_order},
                                   {"cloning_equations", cloning_equations},
                                   {"adaptive_beats_direct", adaptive_beats_direct},
                                   {"adaptive_steps_outgrow", adaptive_steps_outgrow},
                                   {"same_order_of_magnitude", same_order_of_magnitude},
                                   {"cloning_is_behind", cloning_is_behind},
                                   {"cloning_needs_3_7_19", cloning_needs},
                                   {"efficiency_grows", efficiency_grows},
                                   {"first_doubling_matters_most", first_doubling},
                                   {"physical_steps_stay", physical_steps_stay}};
  return decisions;
}

}  // namespace scorecard
