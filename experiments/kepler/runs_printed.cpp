#include "kepler/htvi4_runs.hpp"

std::vector<experiment::KeplerRun> experiment::runs_printed(const KeplerTable& table, double horizon) {
  return htvi4_runs<avi::printed>("printed", table, horizon);
}
