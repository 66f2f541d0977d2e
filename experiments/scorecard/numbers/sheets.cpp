#include "scorecard/numbers/sheets.hpp"

namespace scorecard {

std::vector<Sheet> sheets() {
  return {kepler_sheet("kepler_e090", "Table 1: Kepler, eccentricity 0.9"),
          kepler_sheet("kepler_e099", "Table 2: Kepler, eccentricity 0.99"),
          symplectic_sheet("direct_vs_adaptive", "Table 3: Direct against Adaptive approach"),
          symplectic_sheet("method_comparison", "Table 4: symplectic integrators"),
          symplectic_sheet("p_dependence", "Table 5: dependence on p and p_ring"),
          optimiser_sheet()};
}

}  // namespace scorecard
