#include "common/frame.hpp"
#include "common/timing.hpp"
#include "optimisers/optimiser_arena/meter.hpp"
#include "optimisers/optimiser_arena/standing.hpp"

#include <fmt/format.h>

// Every method on every problem, from the same starts and with the same stopping test: gradients until |g| <=
// delta |g_0|. Medians over three starts: the usual one and two that are moved by a thousandth of its size.

namespace {

using namespace experiment;
using arena::Method, arena::Passage, arena::Passages, arena::Problem, avi::VectorX;

VectorX moved(const Problem& problem, int start) {
  if (start == 0) return problem.x0;
  const double size = avi::largest_entry(problem.x0);
  arena::Numbers numbers(1000 + static_cast<unsigned long>(start));
  return problem.x0 + 1e-3 * (size > 0.0 ? size : 1.0) * numbers.normals(problem.x0.size());
}

/// At each tolerance, of which `wanted` are tried, the run that took fewest gradients, each under the cap.
Passages best_of(const Method& method, const Problem& problem, const VectorX& start, long cap,
                 std::size_t wanted) {
  Passages best{};
  for (const auto& run : method.runs) {
    const Passages now = arena::Meter(problem, start, cap, wanted).run(run);
    for (std::size_t k = 0; k < now.size(); ++k)
      if (best[k].gradients == 0 || now[k].converged > best[k].converged ||
          (now[k].converged == best[k].converged && now[k].gradients < best[k].gradients))
        best[k] = now[k];
    // what needs more than that is not the best at any of them
    if (best[wanted - 1].converged) cap = best[wanted - 1].gradients;
  }
  return best;
}

/// Entry by entry, where every run has converged; else the first that has not.
Passage median_of(const std::vector<Passages>& runs, std::size_t k) {
  for (const Passages& run : runs)
    if (!run[k].converged) return run[k];
  Passage all{.converged = true};
  const auto take = [&](auto member) {
    std::vector<double> values;
    for (const Passages& run : runs)
      values.push_back(run[k].*member);
    all.*member = static_cast<std::decay_t<decltype(all.*member)>>(median(values));
  };
  take(&Passage::iterations), take(&Passage::gradients), take(&Passage::values), take(&Passage::seconds);
  return all;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  const std::vector<Method> methods = arena::all_methods();
  const std::vector<Problem> problems = arena::all_problems(frame.longer, frame.longer);
  constexpr long cap = 20'000, slow_cap = 1000;
  Table& table = frame.table({"problem", "dimension", "method", "delta", "iterations", "gradient_evaluations",
                              "function_evaluations", "converged", "seconds", "group"});
  table.note("group", "tuned: the defaults were fixed on them; looked_at: held out for earlier ones; "
                      "held_out: not looked at until the defaults of avi::minimise() were final");
  table.note("function_evaluations", "calls that ask for the value alone; gradient evaluations give it too");
  table.note("cap", fmt::format("{} evaluations, {} for methods of fixed or adapted learning rates, {} for "
                                "dimensions above 5000, {} above 200 000",
                                cap, slow_cap, cap / 10, cap / 40));
  table.note("starts", "medians over the usual start and two moved by 1e-3; one for the slow and the "
                       "large. Where one does not converge, what it spent; later ones are not asked again");
  std::vector<arena::Instance> instances;
  double done = 0.0;
  for (const Problem& problem : problems) {
    frame.progress(problem.name, done++, problems.size());
    const long n = problem.x0.size();
    if (frame.quick && n > 60) continue;
    for (const double delta : arena::tolerances)
      instances.push_back({problem.name, n, problem.group, delta, {}});
    for (const Method& method : methods) {
      if (method.slow && (frame.quick || n > 5000)) continue;
      std::vector<Passages> runs;
      const int starts = method.slow || n > 5000 || frame.quick ? 1 : 3;
      const long most = method.slow ? slow_cap : n > 200'000 ? cap / 40 : n > 5000 ? cap / 10 : cap;
      std::size_t wanted = arena::tolerances.size();  // what one start missed is not asked again
      for (int start = 0; start < starts && wanted > 0; ++start) {
        runs.push_back(best_of(method, problem, moved(problem, start), most, wanted));
        while (wanted > 0 && !runs.back()[wanted - 1].converged)
          --wanted;
      }
      for (std::size_t k = 0; k < arena::tolerances.size(); ++k) {
        const Passage p = median_of(runs, k);
        table.row(problem.name, n, method.name, arena::tolerances[k], p.iterations, p.gradients, p.values,
                  p.converged, p.seconds, problem.group);
        instances[instances.size() - arena::tolerances.size() + k].by_method[method.name] = p;
      }
    }
  }
  arena::add_summary(frame, instances, methods);
  arena::add_profiles(frame, instances, methods);
}
