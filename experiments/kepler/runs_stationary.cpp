#include "kepler/htvi4_runs.hpp"

std::vector<experiment::KeplerRun> experiment::runs_stationary(const KeplerTable& table, double horizon) {
  return htvi4_runs<avi::stationary>("stationary", table, horizon);
}
