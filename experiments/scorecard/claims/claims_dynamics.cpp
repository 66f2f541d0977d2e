#include "scorecard/claims/claims.hpp"

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

std::vector<Row> rows_of(const experiment::Table& table) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "converged") == "1")
      rows.push_back({table.text(i, "method"), table.text(i, "approach") == "adaptive", table.number(i, "p"),
                      table.number(i, "p_ring"), table.number(i, "h"), table.number(i, "iterations"),
                      table.number(i, "gradient_evaluations")});
  return rows;
}

/// The same rows with iterations and gradients until the stopping test holds for good; those whose run was
/// not followed so far are left out.
std::vector<Row> sustained_rows(const Results& data, const char* stem) {
  const experiment::Table& table = data("sustained_convergence");
  std::vector<Row> rows;
  for (Row row : rows_of(data(stem)))
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const bool same_ring =
          row.adaptive ? table.number(i, "p_ring") == row.p_ring : std::isnan(table.number(i, "p_ring"));
      if (table.text(i, "method") != row.method || table.number(i, "p") != row.p || !same_ring ||
          table.number(i, "h") != row.h || table.text(i, "confirmed") != "1")
        continue;
      row.gradients = std::round(row.gradients / row.iterations) * table.number(i, "sustained");
      row.iterations = table.number(i, "sustained");
      rows.push_back(row);
      break;
    }
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

Finding adaptive_beats_direct(const Results& data) {
  std::size_t holding = 0;
  std::string seen;
  const auto cases = pairs(sustained_rows(data, "direct_vs_adaptive"), [&](const Row& d, const Row& a) {
    holding += 2.0 * a.iterations < d.iterations;
    seen += fmt::format("{}{:.1f}", seen.empty() ? "" : ", ", d.iterations / a.iterations);
  });
  return {in_cases(holding, cases), seen + " times fewer iterations until the stopping test holds for good."};
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
  const auto rows = sustained_rows(data, "method_comparison");
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
    seen += fmt::format("{}{} {:.0f} to {:.0f}", seen.empty() ? "" : ", ", adaptive ? "Adaptive" : "Direct",
                        least, most);
  }
  return {in_cases(holding, cases), seen + " iterations until the stopping test holds for good."};
}

double printed_gradients(const std::string& method) {
  return method == "clone_strang" ? 3.0 : method == "clone_y4" ? 7.0 : 19.0;
}

/// The gradient that only the stopping test needs is counted, as it is for the others, whose next step uses
/// it.
Finding cloning_is_behind(const Results& data) {
  const auto rows = sustained_rows(data, "method_comparison");
  std::size_t behind = 0, cases = 0;
  double least = 1e99;
  for (const Row& row : rows) {
    if (!row.method.starts_with("clone")) continue;
    double slowest = 0.0;
    for (const Row& other : rows)
      if (other.adaptive == row.adaptive && !other.method.starts_with("clone"))
        slowest = std::max(slowest, other.gradients);
    if (slowest == 0.0) continue;
    ++cases;
    behind += row.gradients > 1.5 * slowest;
    least = std::min(least, row.gradients / slowest);
  }
  return {in_cases(behind, cases),
          fmt::format(
              "In {} of {} rows, until the stopping test holds for good: at least {:.2f} times the gradients "
              "of the slower of HTVI and splitting, of a cloning step only those counted that its iterates "
              "and the test depend on.",
              behind, cases, least)};
}

/// As it is defined, with both copies advanced, a step needs what the paper says; the iterates do not.
Finding cloning_needs(const Results& data) {
  std::size_t needed = 0, cases = 0;
  std::map<std::string, double> counts;
  for (const Row& row : rows_of(data("method_comparison"))) {
    if (!row.method.starts_with("clone")) continue;
    const double useful = std::round(row.gradients / row.iterations) - 1.0;  // one is the stopping test's
    ++cases;
    needed += useful >= printed_gradients(row.method);
    counts[row.method] = useful;
  }
  std::string seen;
  for (const auto& [method, count] : counts)
    seen += fmt::format("{}{:.0f}", seen.empty() ? "" : ", ", count);
  return {
      in_cases(cases + needed, 2 * cases),
      "As defined, with both copies advanced, it does. The copy that is read never sees the other: the same "
      "iterates take " +
          seen + " gradients a step."};
}

/// Rows along a sweep of p at p_ring = 1, or of p_ring at p = 4.
std::map<double, Row> sweep(const Results& data, bool of_p) {
  std::map<double, Row> found;
  for (const Row& row : sustained_rows(data, "p_dependence"))
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
  return {in_cases(holding, cases),
          seen + " iterations along the two sweeps until the stopping test holds for good."};
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
  static const Decisions decisions{{"adaptive_beats_direct", adaptive_beats_direct},
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
