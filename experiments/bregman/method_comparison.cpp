#include "bregman/table.hpp"

// Iterations and gradient evaluations of the symplectic integrators at p = 4, Direct and Adaptive (p_ring =
// 1).
int main(int argc, char** argv) {
  return experiment::iteration_table(argc, argv, AVI_SHOWS, experiment::method_comparison_settings());
}
