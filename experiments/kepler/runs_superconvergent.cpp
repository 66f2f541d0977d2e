#include "kepler/htvi4_runs.hpp"

std::vector<experiment::KeplerRun> experiment::runs_superconvergent(const KeplerTable& table,
                                                                    double horizon) {
  return htvi4_runs<avi::superconvergent>("superconvergent", table, horizon);
}
