#include "kepler/table.hpp"

// Errors against the step of each construction at the settings of Table 1 (e = 0.9), from 2 h down to h/8.
void experiment::conduct(Frame& frame) {
  Table& out = frame.table(
      {"method", "construction", "r", "rule", "monitor", "h", "steps", "energy_error", "global_error"});
  out.note("eccentricity", 0.9);
  const KeplerTable printed = table1();
  const auto sweep = [&](auto&& runs_at) {
    const auto rows = runs_at(printed).size();
    for (std::size_t i = 0; i < rows; ++i)
      for (int k = -2; k <= 6; ++k) {
        KeplerTable scaled = printed;
        for (KeplerRow& row : scaled.htvi)
          row.h *= std::exp2(-0.5 * k);
        const KeplerRun run = runs_at(scaled)[i];
        if (run.row.monitor == "none") continue;
        const KeplerResult made = run.measure();
        out.row(run.name.method, run.name.construction, run.name.r, run.name.rule, run.row.monitor, run.row.h,
                made.steps, made.energy_error, made.global_error);
      }
  };
  for (const char* rule : {"simpson", "gauss4"})
    for (const char* construction : {"authors", "printed"})
      sweep([&](const KeplerTable& table) { return htvi4_runs(construction, table, rule); });
  sweep([&](const KeplerTable& table) { return stationary_runs(table); });
}
