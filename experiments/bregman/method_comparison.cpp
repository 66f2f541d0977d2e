#include "bregman/table.hpp"

// Iterations and gradient evaluations of the symplectic integrators at p = 4, Direct and Adaptive (p_ring =
// 1).
int main(int argc, char** argv) {
  return experiment::iteration_table(argc, argv, "method_comparison",
                                     "Symplectic integrators of Bregman dynamics side by side",
                                     experiment::method_comparison_settings());
}
