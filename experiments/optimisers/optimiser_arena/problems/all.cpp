#include "optimisers/optimiser_arena/problems/all.hpp"

namespace arena {

// The defaults of avi::minimise() were fixed on the tuned problems. The held-out ones were chosen by two
// rules before any method was run on any of them: the classics that the arena lacked, and every class of
// statistics and of non-convex functions that is drawn at random, once more, at twice the size and with
// other numbers.

std::vector<Problem> tuned_problems(bool large) {
  std::vector<Problem> all;
  for (auto& kind : {convex_problems(large), statistics_problems(), classic_problems(), non_convex_problems(),
                     degenerate_problems(large)})
    all.insert(all.end(), kind.begin(), kind.end());
  return all;
}

std::vector<Problem> held_out_problems() {
  const Draw again{.suffix = "_again", .times = 2, .seed = 1000};
  std::vector<Problem> all;
  for (auto& kind :
       {remaining_classic_problems(), statistics_problems(again), drawn_non_convex_problems(again)})
    all.insert(all.end(), kind.begin(), kind.end());
  for (Problem& problem : all)
    problem.held_out = true;
  return all;
}

}  // namespace arena
