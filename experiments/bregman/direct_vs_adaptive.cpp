#include "bregman/table.hpp"

// Iterations until convergence of HTVI and of cloning with Yoshida 4, Direct against Adaptive, p = 4 and 10.
void experiment::conduct(Frame& frame) { iteration_table(frame, direct_vs_adaptive_settings()); }
