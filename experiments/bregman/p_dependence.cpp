#include "bregman/table.hpp"

// Iterations of the Adaptive HTVI as p grows at p_ring = 1, and as p_ring falls at p = 4.
int main(int argc, char** argv) {
  return experiment::iteration_table(argc, argv, AVI_SHOWS, experiment::p_dependence_settings());
}
