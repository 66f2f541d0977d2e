#include "bregman/table.hpp"

// Iterations of the Adaptive HTVI as p grows at p_ring = 1, and as p_ring falls at p = 4.
int main(int argc, char** argv) {
  return experiment::iteration_table(argc, argv, "p_dependence",
                                     "Adaptive HTVI as p and p_ring vary: everything follows P = p^2/p_ring",
                                     experiment::p_dependence_settings());
}
