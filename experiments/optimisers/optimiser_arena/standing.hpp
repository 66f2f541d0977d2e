#pragma once
#include "common/frame.hpp"
#include "optimisers/optimiser_arena/meter.hpp"

#include <algorithm>
#include <map>

// The standing of the methods: means and profiles.

namespace arena {

using experiment::Table;

/// One problem at one tolerance, and what each method did there.
struct Instance {
  std::string problem;
  long dimension = 0;
  std::string group;
  double delta = 0.0;
  std::map<std::string, Passage> by_method;
};

/// Gradients and values that were asked for alone; infinite where a method failed.
inline double cost(const Passage& p) {
  return p.converged ? static_cast<double>(p.gradients + p.values) : HUGE_VAL;
}

/// The same of a method, infinite where it was not run, too.
inline double cost(const Instance& instance, const std::string& method) {
  const auto found = instance.by_method.find(method);
  return found == instance.by_method.end() ? HUGE_VAL : cost(found->second);
}

inline double best(const Instance& instance) {
  double least = HUGE_VAL;
  for (const auto& [method, passage] : instance.by_method)
    least = std::min(least, cost(passage));
  return least;
}

/// Geometric mean, built up.
struct Mean {
  double logs = 0.0;
  long count = 0;
  void add(double value) { logs += std::log(value), ++count; }
  [[nodiscard]] double value() const { return count > 0 ? std::exp(logs / count) : std::nan(""); }
};

/// Table optimiser_arena_summary: means and failures by method.
inline void add_summary(experiment::Frame& frame, const std::vector<Instance>& instances,
                        const std::vector<Method>& methods) {
  Table& table =
      frame.table("summary", {"group", "method", "instances", "failures", "per_iteration", "ratio_to_lbfgs",
                              "ratio_to_best_cg", "evaluations_to_best_cg", "within_2"});
  table.note("per_iteration", "geometric mean of gradients and values over the instances that it solved");
  table.note("ratio_to_lbfgs", "geometric mean of the ratio of gradients where both converged");
  table.note(
      "ratio_to_best_cg",
      "likewise to the conjugate gradients that needed fewest; evaluations_to_best_cg counts values too");
  table.note(
      "within_2",
      "share of instances where no method needed fewer than half as many evaluations, values alone included");
  for (const std::string group : {"all", "tuned", "looked_at", "held_out"})
    for (const auto& [method, runs, slow] : methods) {
      Mean iteration, lbfgs, cg, cg_all;
      long count = 0, failures = 0, within_2 = 0;
      for (const Instance& instance : instances) {
        if (group != "all" && instance.group != group) continue;
        const auto found = instance.by_method.find(method);
        if (found == instance.by_method.end()) continue;
        ++count;
        const Passage& own = found->second;
        if (!own.converged) {
          ++failures;
          continue;
        }
        const double spent = static_cast<double>(own.gradients), with_values = cost(own);
        if (own.iterations > 0) iteration.add(with_values / own.iterations);
        within_2 += with_values <= 2.0 * best(instance);
        if (const double other = cost(instance, "lbfgs"); other < HUGE_VAL) lbfgs.add(spent / other);
        double other = HUGE_VAL, other_all = HUGE_VAL;
        for (const char* name : {"cg_pr", "cg_hz", "gsl_conjugate_fr", "gsl_conjugate_pr"})
          if (cost(instance, name) < HUGE_VAL) {
            const Passage& p = instance.by_method.at(name);
            other = std::min(other, static_cast<double>(p.gradients));
            other_all = std::min(other_all, cost(p));
          }
        if (other < HUGE_VAL) cg.add(spent / other), cg_all.add(with_values / other_all);
      }
      if (count == 0) continue;
      table.row(group, method, count, failures, iteration.value(), lbfgs.value(), cg.value(), cg_all.value(),
                within_2 / static_cast<double>(count));
    }
}

/// Tables _profiles and _budgets: performance and data profiles.
inline void add_profiles(experiment::Frame& frame, const std::vector<Instance>& instances,
                         const std::vector<Method>& methods) {
  // An index block for each method; at every instance's own abscissa, so that no grid hides a step.
  Table &performance = frame.table("profiles", {"method", "ratio", "share"}),
        &data = frame.table("budgets", {"method", "evaluations", "share"});
  performance.note("share", "of instances that the method solves with at most `ratio` times the best "
                            "method's evaluations (gradients, and values alone)");
  data.note("share",
            "of instances that the method solves within so many evaluations (the dimension plays no part)");
  for (const auto& [method, runs, slow] : methods) {
    std::vector<double> ratios, costs;
    double count = 0.0;
    for (const Instance& instance : instances) {
      if (!instance.by_method.contains(method)) continue;
      ++count;
      if (const double own = cost(instance, method); own < HUGE_VAL)
        ratios.push_back(own / best(instance)), costs.push_back(own);
    }
    if (count == 0.0) continue;
    std::ranges::sort(ratios), std::ranges::sort(costs);
    performance.row(method, 1.0, std::ranges::count(ratios, 1.0) / count);
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      performance.row(method, ratios[i], (i + 1) / count);
      data.row(method, costs[i], (i + 1) / count);
    }
  }
}

}  // namespace arena
