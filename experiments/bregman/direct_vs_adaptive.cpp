#include "bregman/table.hpp"

// Iterations until convergence of HTVI and of cloning with Yoshida 4, Direct against Adaptive, p = 4 and 10.
int main(int argc, char** argv) {
  return experiment::iteration_table(argc, argv, AVI_SHOWS, experiment::direct_vs_adaptive_settings());
}
