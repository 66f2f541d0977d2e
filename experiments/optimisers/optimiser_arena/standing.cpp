#include "optimisers/optimiser_arena/standing.hpp"

#include <algorithm>
#include <limits>

namespace arena {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Gradients and values that were asked for alone; infinite where a method failed or was not run.
double cost(const std::map<std::string, Passage>& by_method, const std::string& method) {
  const auto found = by_method.find(method);
  return found != by_method.end() && found->second.converged
             ? static_cast<double>(found->second.gradients + found->second.values)
             : infinity;
}

/// Geometric mean, built up.
struct Mean {
  double logs = 0.0;
  long count = 0;
  void add(double value) { logs += std::log(value), ++count; }
  [[nodiscard]] double value() const {
    return count > 0 ? std::exp(logs / static_cast<double>(count)) : std::nan("");
  }
};

}  // namespace

void Standing::add(const Instance& instance, const std::string& method, const Passage& passage) {
  const auto same = [&](const Row& row) {
    return row.instance.problem == instance.problem && row.instance.delta == instance.delta;
  };
  auto row = std::find_if(rows_.begin(), rows_.end(), same);
  if (row == rows_.end()) row = rows_.insert(rows_.end(), {instance, {}});
  row->by_method[method] = passage;
  if (std::find(methods_.begin(), methods_.end(), method) == methods_.end()) methods_.push_back(method);
}

double Standing::best(const Row& row) {
  double least = infinity;
  for (const auto& [method, passage] : row.by_method)
    least = std::min(least, cost(row.by_method, method));
  return least;
}

void Standing::write_summary(const experiment::Frame& frame) const {
  experiment::Table table = frame.table(
      {"group", "method", "instances", "failures", "gradient_mean", "evaluation_mean", "per_iteration",
       "ratio_to_lbfgs", "ratio_to_best_cg", "evaluations_to_best_cg", "within_1", "within_2"});
  table.note("means",
             "geometric; of gradients, and of gradients and values, over the instances that it solved");
  table.note("ratio_to_lbfgs", "geometric mean of the ratio of gradients where both converged");
  table.note(
      "ratio_to_best_cg",
      "likewise to the conjugate gradients that needed fewest; evaluations_to_best_cg counts values too");
  table.note(
      "within_2",
      "share of instances where no method needed fewer than half as many evaluations, values alone included");
  for (const std::string group : {"all", "tuned", "looked_at", "held_out"})
    for (const std::string& method : methods_) {
      Mean gradients, evaluations, iteration, lbfgs, cg, cg_all;
      long instances = 0, failures = 0, within_1 = 0, within_2 = 0;
      for (const Row& row : rows_) {
        if (group != "all" && row.instance.group != group) continue;
        const auto found = row.by_method.find(method);
        if (found == row.by_method.end()) continue;
        ++instances;
        const Passage& own = found->second;
        if (!own.converged) {
          ++failures;
          continue;
        }
        const double spent = static_cast<double>(own.gradients),
                     with_values = static_cast<double>(own.gradients + own.values);
        gradients.add(spent), evaluations.add(with_values);
        if (own.iterations > 0) iteration.add(with_values / static_cast<double>(own.iterations));
        within_1 += with_values <= best(row), within_2 += with_values <= 2.0 * best(row);
        if (const double other = cost(row.by_method, "lbfgs"); other < infinity) lbfgs.add(spent / other);
        double other = infinity, other_all = infinity;
        for (const char* name : {"cg_pr", "cg_hz", "gsl_conjugate_fr", "gsl_conjugate_pr"})
          if (cost(row.by_method, name) < infinity) {
            const Passage& p = row.by_method.at(name);
            other = std::min(other, static_cast<double>(p.gradients));
            other_all = std::min(other_all, static_cast<double>(p.gradients + p.values));
          }
        if (other < infinity) cg.add(spent / other), cg_all.add(with_values / other_all);
      }
      if (instances == 0) continue;
      table.row(group, method, instances, failures, gradients.value(), evaluations.value(), iteration.value(),
                lbfgs.value(), cg.value(), cg_all.value(),
                static_cast<double>(within_1) / static_cast<double>(instances),
                static_cast<double>(within_2) / static_cast<double>(instances));
    }
  frame.write(table, "summary");
}

void Standing::write_profiles(const experiment::Frame& frame) const {
  // An index block for each method; at every instance's own abscissa, so that no grid hides a step.
  experiment::Table performance = frame.table({"method", "ratio", "share"}),
                    data = frame.table({"method", "evaluations", "share"});
  performance.note("share", "of instances that the method solves with at most `ratio` times the best "
                            "method's evaluations (gradients, and values alone)");
  data.note("share",
            "of instances that the method solves within so many evaluations (the dimension plays no part)");
  for (const std::string& method : methods_) {
    std::vector<double> ratios, costs;
    double instances = 0.0;
    for (const Row& row : rows_) {
      if (!row.by_method.contains(method)) continue;
      ++instances;
      if (const double own = cost(row.by_method, method); own < infinity)
        ratios.push_back(own / best(row)), costs.push_back(own);
    }
    std::sort(ratios.begin(), ratios.end()), std::sort(costs.begin(), costs.end());
    performance.row(method, 1.0,
                    static_cast<double>(std::count(ratios.begin(), ratios.end(), 1.0)) / instances);
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      performance.row(method, ratios[i], static_cast<double>(i + 1) / instances);
      data.row(method, costs[i], static_cast<double>(i + 1) / instances);
    }
  }
  frame.write(performance, "profiles");
  frame.write(data, "budgets");
}

void Standing::write_losses(const experiment::Frame& frame) const {
  experiment::Table table = frame.table(
      {"problem", "dimension", "held_out", "delta", "evaluations", "best_method", "best", "ratio"});
  for (const Row& row : rows_) {
    const double own = cost(row.by_method, "minimise_m7"), least = best(row);
    if (!(own > least)) continue;
    std::string winner;
    for (const auto& [method, passage] : row.by_method)
      if (cost(row.by_method, method) == least) winner = method;
    table.row(row.instance.problem, row.instance.dimension, row.instance.group == "held_out" ? 1 : 0,
              row.instance.delta, own, winner, least, own / least);
  }
  frame.write(table, "losses");
}

void Standing::write(const experiment::Frame& frame) const {
  write_summary(frame);
  write_profiles(frame);
  write_losses(frame);
}

}  // namespace arena
