#pragma once
#include "scorecard/numbers/sheet.hpp"

/// @file
/// The judges of the published tables.

namespace scorecard {

/// Tables 1 and 2: HTVI4 and Stormer-Verlet on Kepler's problem.
Judgement judge_kepler(const Cell& cell, const experiment::Table& data);

/// Tables 3 to 5: iterations of symplectic methods on Bregman dynamics.
Judgement judge_symplectic(const Cell& cell, const experiment::Table& data);

/// Table 6: iterations of several optimisers.
Judgement judge_optimisers(const Cell& cell, const experiment::Table& data);

/// The paper's tables in its order, which are counted without the one of formulas between the second and the
/// third.
inline std::vector<Sheet> sheets() {
  return {{"kepler_e090", "Table 1: Kepler, eccentricity 0.9", judge_kepler},
          {"kepler_e099", "Table 2: Kepler, eccentricity 0.99", judge_kepler},
          {"direct_vs_adaptive", "Table 3: Direct against Adaptive approach", judge_symplectic},
          {"method_comparison", "Table 4: symplectic integrators", judge_symplectic},
          {"p_dependence", "Table 5: dependence on p and p_ring", judge_symplectic},
          {"optimiser_comparison", "Table 6: optimisers over nine tolerances", judge_optimisers}};
}

}  // namespace scorecard
