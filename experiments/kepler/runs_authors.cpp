#include "kepler/htvi4_runs.hpp"

std::vector<experiment::KeplerRun> experiment::runs_authors(const KeplerTable& table, double horizon) {
  return htvi4_runs<avi::authors>("authors", table, horizon);
}
