#include "kepler/table.hpp"

#include <limits>

// Table 1 of the paper, e = 0.9. Its arclength row prints the step bounds a h, b h where the other rows print
// a, b; only a = 0.03, b = 3 gives its steps.
int main(int argc, char** argv) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return experiment::kepler_table(argc, argv, "kepler_e090",
                                  {.eccentricity = 0.9,
                                   .htvi = {{"gamma", 0.1, 0.01, 8.0},
                                            {"energy", 0.1, 1e-4, 2.0},
                                            {"arclength", 0.1, 0.03, 3.0},
                                            {"none", 0.0025, none, none}},
                                   .verlet_h = 5e-5,
                                   .rounds = 15});
}
