#include "common/frame.hpp"
#include "optimisers/optimiser_arena/meter.hpp"
#include "optimisers/optimiser_arena/problems/all.hpp"
#include "optimisers/optimiser_arena/standing.hpp"

#include "avi/optim/run_updates.hpp"

#include <fmt/format.h>

#include <algorithm>

// Every method on every problem, from the same starts and with the same stopping test: gradients until |g| <=
// delta |g_0|. Medians over three starts: the usual one and two that are moved by a thousandth of its size.

namespace {

using namespace experiment;
using arena::Method;
using arena::Passage;
using arena::Problem;
using avi::VectorX;
using Passages = std::array<Passage, arena::tolerances.size()>;

VectorX moved(const Problem& problem, int start) {
  if (start == 0) return problem.x0;
  const double size = avi::detail::largest(problem.x0);
  arena::Numbers numbers(1000 + static_cast<unsigned long>(start));
  return problem.x0 + 1e-3 * (size > 0.0 ? size : 1.0) * numbers.normals(problem.x0.size());
}

/// One start, under one cap, until the last of the tolerances that are wanted.
struct Trial {
  const Problem& problem;
  VectorX start;
  long cap;
  std::size_t wanted;
};

Passages once(const Trial& trial, const std::function<void(arena::Meter&)>& run) {
  arena::Meter meter(trial.problem, trial.start, trial.cap, trial.wanted);
  try {
    run(meter);
  } catch (const arena::Over&) {
  }
  Passages passages = meter.passages;
  for (Passage& passage : passages)
    if (!passage.converged) {
      passage = meter.spent();
      passage.iterations = meter.iterations;
    }
  return passages;
}

/// At each tolerance the choice that took fewest gradients.
Passages best_of(const Trial& trial, const Method& method) {
  if (method.choices.empty()) return once(trial, method.run);
  Passages best{};
  Trial next = trial;
  for (const auto& run : method.choices) {
    const Passages now = once(next, run);
    for (std::size_t k = 0; k < now.size(); ++k)
      if (best[k].gradients == 0 || now[k].converged > best[k].converged ||
          (now[k].converged == best[k].converged && now[k].gradients < best[k].gradients))
        best[k] = now[k];
    // what needs more than that is not the best at any of them
    if (best[trial.wanted - 1].converged) next.cap = best[trial.wanted - 1].gradients;
  }
  return best;
}

template <class T>
T middle(std::vector<T> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Entry by entry, where every run has converged; else the first that has not.
Passage median_of(const std::vector<Passages>& runs, std::size_t k) {
  for (const Passages& run : runs)
    if (!run[k].converged) return run[k];
  const auto of = [&](auto member) {
    std::vector<std::decay_t<decltype(Passage{}.*member)>> values;
    for (const Passages& run : runs)
      values.push_back(run[k].*member);
    return middle(values);
  };
  return {of(&Passage::iterations), of(&Passage::gradients), of(&Passage::values), of(&Passage::seconds),
          true};
}

}  // namespace

int main(int argc, char** argv) {
  bool full = false;
  return run(
      argc, argv, "optimiser_arena", "Gradients that each optimiser needs on every problem of the arena",
      [&](CLI::App& app) { add_flag(app, "--full", full, "dimensions up to 1e6"); },
      [&](Frame& frame) {
        std::vector<Method> methods;
        for (const auto& group : {arena::own_methods(), arena::first_order_methods(),
                                  arena::conjugate_gradients(), arena::library_methods()})
          methods.insert(methods.end(), group.begin(), group.end());
        std::vector<Problem> problems = arena::tuned_problems(full);
        for (const auto& others : {arena::looked_at_problems(full), arena::held_out_problems()})
          problems.insert(problems.end(), others.begin(), others.end());
        constexpr long cap = 20'000, slow_cap = 1000;
        Table table = frame.table({"problem", "dimension", "held_out", "method", "delta", "iterations",
                                   "gradient_evaluations", "function_evaluations", "converged", "seconds",
                                   "kind", "group"});
        table.note("group", "tuned: the defaults were fixed on them; looked_at: held out for earlier ones");
        table.note("held_out", "1: not looked at until the defaults of avi::minimise() were final");
        table.note("function_evaluations",
                   "calls that ask for the value alone; gradient evaluations give it too");
        table.note("cap",
                   fmt::format("{} evaluations, {} for methods of fixed or adapted learning rates, {} for "
                               "dimensions above 5000, {} above 200 000",
                               cap, slow_cap, cap / 10, cap / 40));
        table.note(
            "starts",
            "medians over the usual start and two moved by 1e-3; one for the slow and the large. Where one "
            "does not converge, what it spent; later ones are not asked again");
        arena::Standing standing;
        double done = 0.0;
        for (const Problem& problem : problems) {
          frame.progress(problem.name, done++ / static_cast<double>(problems.size()));
          const long n = static_cast<long>(problem.x0.size());
          if (frame.quick && n > 60) continue;
          for (const Method& method : methods) {
            if (method.slow && (frame.quick || n > 5000)) continue;
            std::vector<Passages> runs;
            const int starts = method.slow || n > 5000 || frame.quick ? 1 : 3;
            std::size_t wanted =
                arena::tolerances.size();  // a tolerance that one start missed is not asked again
            for (int start = 0; start < starts && wanted > 0; ++start) {
              const long most = method.slow ? slow_cap : n > 200'000 ? cap / 40 : n > 5000 ? cap / 10 : cap;
              runs.push_back(best_of({problem, moved(problem, start), most, wanted}, method));
              while (wanted > 0 && !runs.back()[wanted - 1].converged)
                --wanted;
            }
            for (std::size_t k = 0; k < arena::tolerances.size(); ++k) {
              const Passage p = median_of(runs, k);
              table.row(problem.name, n, problem.group == "held_out" ? 1 : 0, method.name,
                        arena::tolerances[k], p.iterations, p.gradients, p.values, p.converged ? 1 : 0,
                        p.seconds, problem.kind, problem.group);
              standing.add({problem.name, n, problem.group, arena::tolerances[k]}, method.name, p);
            }
          }
        }
        standing.write(frame);
        frame.write(table);
      });
}
