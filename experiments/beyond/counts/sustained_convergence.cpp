#include "beyond/counts/sustained.hpp"
#include "bregman/table.hpp"

// Iterations until the stopping test holds permanently, compared with the first time it holds, which the
// paper counts. The trajectory oscillates, and the test first holds near a chance zero of f.

namespace {

using namespace experiment;

/// f around and after the first time the test holds, for the figure.
void add_curve(Table& curves, const Setting& s, long first_passage) {
  const long length = 4 * first_passage;
  const CorrelatedQuartic f;
  Curve curve(length / 600.0);
  run_setting(s, f, f.start(), {.delta = 0.0, .iterations = length}, curve);
  curve.append(curves, {label_of(s), s.approach(), std::to_string(first_passage)});
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"method", "approach", "p", "p_ring", "h", "first_passage", "sustained", "ratio",
                              "value_at_first_passage", "rebound", "confirmed", "outcome"});
  table.note("delta", 1e-10);
  table.note("sustained", "first iteration from which the test holds until the run is twice as long");
  table.note("rebound", "largest f within the 5 % of iterations after the first passage");
  Table& curves = frame.table("curves", Curve::columns_after({"curve", "approach", "first_passage"}));
  const CorrelatedQuartic f;
  each_setting(frame, all_settings(), [&](const Setting& s, bool) {
    Sustained seen;
    const auto result = run_setting(s, f, f.start(), {.delta = 0.0, .iterations = seen.cap}, seen);
    table.row(s.method, s.approach(), s.p, s.p_ring_or_nan(), s.h, seen.first, seen.sustained(),
              1.0 * seen.sustained() / seen.first, seen.at_first, seen.rebound, seen.confirmed,
              avi::name(result.outcome));
    if (s.method == "htvi" && s.p == 4 && (s.h == 8e-4 || s.h == 2.4e-4)) add_curve(curves, s, seen.first);
  });
}
