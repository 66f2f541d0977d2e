#pragma once
#include "scorecard/numbers/sheet.hpp"

/// @file
/// The sheets of the scorecard, in the order of the paper's tables, which are counted without the one of
/// formulas between the second and the third.

namespace scorecard {

/// Tables 1 and 2: HTVI4 and Stormer-Verlet on Kepler's problem (data: kepler_e090, kepler_e099).
Sheet kepler_sheet(std::string stem, std::string title);

/// Tables 3 to 5: iterations of symplectic methods on Bregman dynamics (data: direct_vs_adaptive,
/// method_comparison, p_dependence).
Sheet symplectic_sheet(std::string stem, std::string title);

/// Table 6: iterations of several optimisers (data: optimiser_comparison).
Sheet optimiser_sheet();

/// Every sheet there is.
std::vector<Sheet> sheets();

}  // namespace scorecard
