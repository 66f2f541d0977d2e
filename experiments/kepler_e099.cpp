#include "kepler/table.hpp"

#include <limits>

// Table 2 of the paper, e = 0.99. Its arclength row prints h = 0.1; only h = 0.05 gives its steps.
int main(int argc, char** argv) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return experiment::kepler_table(argc, argv, "kepler_e099",
                                  {.eccentricity = 0.99,
                                   .htvi = {{"gamma", 0.1, 5e-4, 8.0},
                                            {"energy", 0.03, 1e-6, 5.0},
                                            {"arclength", 0.05, 8e-4, 10.0},
                                            {"none", 5e-4, none, none}},
                                   .verlet_h = 5e-7,
                                   .rounds = 5});
}
