#include "scorecard/claims/claims.hpp"

#include <algorithm>
#include <stdexcept>

// Claims of Sections 4.2 to 4.5.3: Bregman dynamics, Direct and Adaptive, by symplectic methods.

namespace scorecard {
namespace {

constexpr const char* until_it_holds = "iterations until the stopping test holds for good.";

/// A converged row of an iteration table.
struct Run {
  std::string method;
  bool adaptive;
  double p, p_ring, h, iterations, gradients;

  [[nodiscard]] bool clones() const { return method.starts_with("clone"); }
  /// Physical time at the end: t^s = 1 + n h, s = p_ring / p.
  [[nodiscard]] double t_end() const {
    return adaptive ? std::pow(1.0 + iterations * h, p / p_ring) : 1.0 + iterations * h;
  }
  /// Physical step at the end.
  [[nodiscard]] double last_step() const {
    return adaptive ? h * p / p_ring * std::pow(t_end(), 1.0 - p_ring / p) : h;
  }
  [[nodiscard]] double mean_step() const { return (t_end() - 1.0) / iterations; }
};

/// The converged rows of a table; where `for_good`, with iterations and gradients until the stopping test
/// holds for good, without those runs that were not followed so far.
std::vector<Run> runs(const Results& data, const char* stem, bool for_good) {
  std::vector<Run> found;
  for (const Row& row : data.rows(stem, {{"converged", "1"}})) {
    Run run{row.text("method"),
            row.text("approach") == "adaptive",
            row.number("p"),
            row.number("p_ring"),
            row.number("h"),
            row.number("iterations"),
            row.number("gradient_evaluations")};
    if (for_good) {
      const auto followed = data.rows("sustained_convergence", {{"method", row.text("method")},
                                                                {"p", row.text("p")},
                                                                {"p_ring", row.text("p_ring")},
                                                                {"h", row.text("h")},
                                                                {"confirmed", "1"}});
      if (followed.empty()) continue;
      run.gradients = std::round(run.gradients / run.iterations) * followed[0].number("sustained");
      run.iterations = followed[0].number("sustained");
    }
    found.push_back(run);
  }
  return found;
}

/// Direct and Adaptive runs with the same method and p.
std::vector<std::pair<Run, Run>> pairs(const std::vector<Run>& runs) {
  std::vector<std::pair<Run, Run>> found;
  for (const Run& d : runs)
    for (const Run& a : runs)
      if (!d.adaptive && a.adaptive && d.method == a.method && d.p == a.p) found.emplace_back(d, a);
  return found;
}

Finding adaptive_beats_direct(const Results& data) {
  Cases cases;
  std::vector<double> seen;
  for (const auto& [direct, adaptive] : pairs(runs(data, "direct_vs_adaptive", true))) {
    seen.push_back(direct.iterations / adaptive.iterations);
    cases.add(seen.back() > 2.0);
  }
  return finding(in_cases(cases), "{:.1f} times fewer {}", fmt::join(seen, ", "), until_it_holds);
}

Finding adaptive_steps_outgrow(const Results& data) {
  Cases cases;
  std::vector<double> seen;
  for (const auto& [direct, adaptive] : pairs(runs(data, "direct_vs_adaptive", false))) {
    seen.push_back(adaptive.last_step() / direct.last_step());
    cases.add(seen.back() > 1.0);
  }
  return finding(in_cases(cases), "At the first passage they are {:.1f} times as long.",
                 fmt::join(seen, ", "));
}

Finding same_order_of_magnitude(const Results& data) {
  Cases cases;
  std::vector<std::string> seen;
  for (const bool adaptive : {false, true}) {
    Cases iterations;
    for (const Run& run : runs(data, "method_comparison", true))
      if (run.adaptive == adaptive) iterations.add(true, run.iterations);
    if (iterations.all == 0) continue;
    cases.add(iterations.most < 10.0 * iterations.least);
    seen.push_back(fmt::format("{} {:.0f} to {:.0f}", adaptive ? "Adaptive" : "Direct", iterations.least,
                               iterations.most));
  }
  return finding(in_cases(cases), "{} {}", fmt::join(seen, ", "), until_it_holds);
}

/// The gradient that only the stopping test needs is counted, as it is for the others, whose next step uses
/// it. Strang's cloning may be read from either copy: the one of the source's counts is moved first, and the
/// test at its end needs a gradient of its own; the other is kicked first, and shares its gradient with the
/// test.
Finding cloning_is_behind(const Results& data) {
  const auto all = runs(data, "method_comparison", true);
  const auto slowest = [&](bool adaptive) {
    double most = 0.0;
    for (const Run& run : all)
      if (run.adaptive == adaptive && !run.clones()) most = std::max(most, run.gradients);
    return most;
  };
  Cases read, other;
  const auto compare = [&](Cases& cases, bool adaptive, double gradients) {
    if (const double most = slowest(adaptive); most > 0.0 && std::isfinite(gradients))
      cases.add(gradients > 1.5 * most, gradients / most);
  };
  for (const Run& clone : all)
    if (clone.clones()) compare(read, clone.adaptive, clone.gradients);
  for (const Row& row : data.rows("variants", {{"variant", "kick_first"}}))
    compare(other, row.text("parameter") == "adaptive",
            row.number("sustained") * row.number("gradients_per_step"));
  return finding(
      in_cases(read + other),
      "In {} of {} rows, until the stopping test holds for good, at least {:.2f} times the gradients of the "
      "slower of HTVI and splitting, of a cloning step only those counted that its iterates and the test "
      "depend on. But read from the other copy, which is kicked first, Strang's cloning shares its gradient "
      "with the test and takes {:.2f} to {:.2f} times those of the slower one.",
      read.holding, read.all, read.least, other.least, other.most);
}

/// As it is defined, with both copies advanced, a step needs what the paper says; the iterates do not.
Finding cloning_needs(const Results& data) {
  static const std::map<std::string, double> printed{
      {"clone_strang", 3.0}, {"clone_y4", 7.0}, {"clone_y6", 19.0}};
  Cases cases;
  std::map<std::string, double> useful;
  for (const Run& run : runs(data, "method_comparison", false)) {
    if (!run.clones()) continue;
    useful[run.method] = std::round(run.gradients / run.iterations) - 1.0;  // one is the stopping test's
    cases.add(true);
    cases.add(useful[run.method] >= printed.at(run.method));
  }
  std::vector<double> gradients;
  for (const auto& [method, count] : useful)
    gradients.push_back(count);
  return finding(
      in_cases(cases),
      "As defined, with both copies advanced, it does. The copy that is read sees of the other only its "
      "clock: the same iterates take {:.0f} gradients a step, and the stopping test one more.",
      fmt::join(gradients, ", "));
}

/// Runs along a sweep of p at p_ring = 1, or of falling p_ring at p = 4.
std::vector<Run> sweep(const Results& data, bool of_p) {
  std::vector<Run> found;
  for (const Run& run : runs(data, "p_dependence", true))
    if (of_p ? run.p_ring == 1.0 : run.p == 4.0) found.push_back(run);
  if (found.empty()) throw std::out_of_range("The data hold no run of this sweep.");
  std::ranges::sort(found, {}, [of_p](const Run& run) { return of_p ? run.p : -run.p_ring; });
  return found;
}

Finding efficiency_grows(const Results& data) {
  Cases cases;
  std::vector<std::string> seen;
  for (const bool of_p : {true, false}) {
    std::vector<double> iterations;
    for (const Run& run : sweep(data, of_p)) {
      if (!iterations.empty()) cases.add(run.iterations < iterations.back());
      iterations.push_back(run.iterations);
    }
    seen.push_back(fmt::format("{:.0f}", fmt::join(iterations, ", ")));
  }
  return finding(in_cases(cases),
                 "{} iterations along the two sweeps until the stopping test holds for good.",
                 fmt::join(seen, "; "));
}

/// "Large" is more than a factor two, "minor but noticeable" more than ten per cent and less than that.
Finding first_doubling(const Results& data) {
  std::map<double, double> iterations;
  for (const Run& run : sweep(data, true))
    iterations[run.p] = run.iterations;
  const double first = iterations.at(2.0) / iterations.at(4.0),
               second = iterations.at(4.0) / iterations.at(8.0);
  Cases cases;
  cases.add(first > 2.0 && first > second);
  cases.add(second > 1.1 && second < 2.0);
  return finding(in_cases(cases),
                 "Factors {:.1f} and {:.2f}: the second is noticeable and much the smaller, but not minor "
                 "(which we take to be below 2). The order P = p^2/p_ring goes from 4 to 16 to 64.",
                 first, second);
}

Finding physical_steps_stay(const Results& data) {
  const auto change = [&](bool of_p) {
    const auto along = sweep(data, of_p);
    return along.back().mean_step() / along.front().mean_step();
  };
  Cases cases;
  for (const bool of_p : {true, false})
    cases.add(change(of_p) > 0.5);
  return finding(in_cases(cases),
                 "The mean physical step, until the stopping test holds for good, changes by a factor {:.2g} "
                 "as p goes from 2 to 8, by a factor {:.2g} as p_ring from 2 to 0.1.",
                 change(true), change(false));
}

}  // namespace

Decisions dynamics_decisions() {
  return {{"adaptive_beats_direct", adaptive_beats_direct},
          {"adaptive_steps_outgrow", adaptive_steps_outgrow},
          {"same_order_of_magnitude", same_order_of_magnitude},
          {"cloning_is_behind", cloning_is_behind},
          {"cloning_needs_3_7_19", cloning_needs},
          {"efficiency_grows", efficiency_grows},
          {"first_doubling_matters_most", first_doubling},
          {"physical_steps_stay", physical_steps_stay}};
}

}  // namespace scorecard
