#include "bregman/table.hpp"

// Iteration counts from starts moved by 1e-15 to 1e-6: which published counts are meaningful, and to how many
// digits.

void experiment::conduct(Frame& frame) {
  const long starts = frame.quick ? 4 : 16;
  Table& table = frame.table({"setting", "method", "approach", "p", "p_ring", "h", "iterations", "moved_by",
                              "starts", "least", "most", "failed", "chaotic"});
  table.note("chaotic", "the counts of the moved starts differ, or some runs fail");
  const CorrelatedQuartic f;
  const avi::Stopping stopping{.delta = 1e-10, .iterations = 1'000'000};
  long row = 0;
  each_setting(frame, all_settings(), [&](const Setting& s, bool slow) {
    // ten gradients per step and sixteen starts would take too long
    if (slow && s.method.starts_with("clone_y")) return;
    ++row;
    const long nominal = run_setting(s, f, f.start(), stopping).iterations;
    for (double size : {1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6}) {
      if (slow && (s.method != "htvi" || size < 1e-9) && size != 1e-14) continue;
      const auto moved = perturbed_counts(s, starts, size, stopping);
      table.row(row, s.method, s.approach(), s.p, s.p_ring_or_nan(), s.h, nominal, size, starts,
                moved.least(), moved.most(), moved.failed, moved.failed > 0 || moved.least() != moved.most());
    }
  });
}
