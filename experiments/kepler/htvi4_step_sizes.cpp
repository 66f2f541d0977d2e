#include "kepler/table.hpp"

// Physical steps of HTVI4 in time for the monitors of Table 1, at its settings (e = 0.9).
void experiment::conduct(Frame& frame) {
  Table& out = frame.table({"monitor", "t", "step", "radius"});
  out.note("eccentricity", 0.9);
  for (const KeplerRun& run : htvi4_runs("authors", table1())) {
    if (run.row.monitor == "none") continue;
    double before = 0.0;
    const avi::Run done = run.observe([&](const avi::State<2>& z) {
      out.row(run.row.monitor, z.t, z.t - before, z.q.norm());
      before = z.t;
    });
    if (done.outcome != avi::Outcome::ok) throw std::runtime_error(done.message);
  }
}
