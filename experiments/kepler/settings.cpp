#include "kepler/table.hpp"

namespace experiment {

// The arclength row of Table 1 prints the step bounds a h, b h where the other rows print a, b; only a =
// 0.03, b = 3 gives its steps.
KeplerTable table1() {
  return {.eccentricity = 0.9,
          .htvi = {{"gamma", 0.1, 0.01, 8.0},
                   {"energy", 0.1, 1e-4, 2.0},
                   {"arclength", 0.1, 0.03, 3.0},
                   {"none", 0.0025, none, none}},
          .verlet_h = 5e-5,
          .rounds = 15};
}

// The arclength row of Table 2 prints h = 0.1; only h = 0.05 gives its steps.
KeplerTable table2() {
  return {.eccentricity = 0.99,
          .htvi = {{"gamma", 0.1, 5e-4, 8.0},
                   {"energy", 0.03, 1e-6, 5.0},
                   {"arclength", 0.05, 8e-4, 10.0},
                   {"none", 5e-4, none, none}},
          .verlet_h = 5e-7,
          .rounds = 5};
}

}  // namespace experiment
