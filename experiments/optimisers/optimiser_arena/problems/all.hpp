#pragma once
#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {

/// Problems on which defaults may be chosen; `large` adds and enlarges those of dimension up to 1e6.
std::vector<Problem> tuned_problems(bool large);

/// Problems that were held out for earlier defaults; with `every` the drawn ones, too.
std::vector<Problem> looked_at_problems(bool every);

/// Problems that are run once the defaults are final.
std::vector<Problem> held_out_problems();

}  // namespace arena
