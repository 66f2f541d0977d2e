#include "bregman/table.hpp"

// Iterations of the Adaptive HTVI as p grows at p_ring = 1, and as p_ring falls at p = 4.
void experiment::conduct(Frame& frame) { iteration_table(frame, p_dependence_settings()); }
