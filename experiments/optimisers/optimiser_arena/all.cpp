#include "optimisers/optimiser_arena/all.hpp"

#include <set>

namespace arena {

std::vector<Problem> all_problems(bool large) {
  // Chosen before any method was run on any problem; the defaults of avi::minimise() were fixed on the
  // others.
  static const std::set<std::string> held_out{
      "quadratic_1e6", "membrane",   "minimal_surface", "student",       "poisson_regression", "softmax",
      "trigonometric", "biggs_exp6", "boundary_value",  "lennard_jones", "chained_rosenbrock", "power_8",
      "membrane_large"};
  std::vector<Problem> all;
  for (auto& kind : {convex_problems(large), statistics_problems(), classic_problems(), non_convex_problems(),
                     degenerate_problems(large)})
    for (const Problem& problem : kind)
      all.push_back(problem);
  for (Problem& problem : all)
    problem.held_out = held_out.contains(problem.name);
  return all;
}

}  // namespace arena
