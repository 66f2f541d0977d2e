#pragma once
#include "optimisers/optimiser_arena/problem.hpp"

namespace arena {

/// Every problem of the arena; `large` adds and enlarges those of dimension up to 1e6.
std::vector<Problem> all_problems(bool large);

}  // namespace arena
