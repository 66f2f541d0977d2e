#include "bregman/table.hpp"

// Iterations and gradient evaluations of the symplectic integrators at p = 4, Direct and Adaptive (p_ring =
// 1).
void experiment::conduct(Frame& frame) { iteration_table(frame, method_comparison_settings()); }
