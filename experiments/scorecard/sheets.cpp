#include "scorecard/sheets.hpp"

namespace scorecard {

std::vector<Sheet> sheets() {
  return {kepler_sheet("kepler_e090", "Table 1: Kepler, eccentricity 0.9"),
          kepler_sheet("kepler_e099", "Table 2: Kepler, eccentricity 0.99")};
}

}  // namespace scorecard
