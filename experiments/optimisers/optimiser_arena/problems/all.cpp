#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {

// The defaults of avi::minimise() were fixed on the tuned problems. Others were held out by two rules: the
// classics that the arena lacked, and every class of statistics and of non-convex functions that is drawn at
// random, once more, at twice the size and with other numbers. What was held out for earlier defaults has
// been looked at since; the second rule was then applied once more. Its problems were drawn before any method
// was run on them, and nothing was changed after.

std::vector<Problem> all_problems(bool large, bool again) {
  std::vector<Problem> all;
  std::string group = "tuned", suffix;
  const auto add = [&](std::vector<Problem> problems) {
    for (Problem& problem : problems) {
      problem.name += suffix, problem.group = group;
      all.push_back(std::move(problem));
    }
  };
  const auto add_drawn = [&](Index k, unsigned long seed) {
    add(statistics_problems(k, seed));
    add(drawn_non_convex_problems(k, seed));
  };
  add(convex_problems(large));
  add(statistics_problems(1, 0));
  add(classic_problems());
  add(drawn_non_convex_problems(1, 0));
  add(other_non_convex_problems());
  add(degenerate_problems(large));
  group = "looked_at", suffix = "_again";
  if (again) add_drawn(2, 1000);
  suffix = "";
  add(remaining_classic_problems());
  group = "held_out", suffix = "_fresh";
  add_drawn(2, 3000);
  return all;
}

}  // namespace arena
