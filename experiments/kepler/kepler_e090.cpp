#include "kepler/table.hpp"

void experiment::conduct(Frame& frame) { kepler_table(frame, table1()); }
