#pragma once
#include "common/frame.hpp"
#include "optimisers/optimiser_arena/meter.hpp"

#include <map>

/// @file
/// The standing of the methods: means and profiles.

namespace arena {

/// One problem at one tolerance, and what each method did there.
struct Instance {
  std::string problem;
  long dimension = 0;
  std::string group;
  double delta = 0.0;
  std::map<std::string, Passage> by_method;
};

/// Writes optimiser_arena_summary (means and failures by method), _profiles and _budgets (performance and
/// data profiles).
void write_standing(const experiment::Frame& frame, const std::vector<Instance>& instances,
                    const std::vector<Method>& methods);

}  // namespace arena
