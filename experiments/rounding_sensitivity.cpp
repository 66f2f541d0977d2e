#include "accelerated/table.hpp"

// Counts from starts moved by 1e-16 to 1e-6: which published counts mean something, and to how many digits.

int main(int argc, char** argv) {
  using namespace experiment;
  long starts = 16;
  return run(
      argc, argv, "rounding_sensitivity", "How far published iteration counts move with the last bit",
      [&](CLI::App& app) {
        add_count(app, "--starts", starts, 2, 1000, "Moved starts for each setting and size");
      },
      [&](Frame& frame) {
        if (frame.quick) starts = std::min(starts, 4L);
        avi::Table table =
            frame.table({"setting", "method", "approach", "p", "p_ring", "h", "iterations", "moved_by",
                         "starts", "least", "median", "most", "unchanged", "failed", "chaotic"});
        table.note("chaotic", "the counts of the moved starts differ, or some runs fail");
        const avi::CorrelatedQuartic f;
        const avi::Stopping stopping{.delta = 1e-10, .iterations = 1'000'000};
        const auto settings = all_settings();
        long row = 0;
        for (std::size_t i = 0; i < settings.size(); ++i) {
          const Setting& s = settings[i];
          frame.progress(label_of(s), static_cast<double>(i) / static_cast<double>(settings.size()));
          const bool slow = s.is_direct() && s.p < 5;
          if (slow && (frame.quick || s.method == "clone_y4" || s.method == "clone_y6")) continue;
          ++row;
          const long nominal = run_setting(s, f, f.start(), stopping).iterations;
          for (double size : {1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6}) {
            if (slow && (s.method != "htvi" || size < 1e-9) && size != 1e-14) continue;
            const auto moved = perturbed_counts(s, starts, size, stopping);
            table.row(row, s.method, s.approach(), s.p, s.is_direct() ? std::nan("") : s.p_ring, s.h, nominal,
                      size, starts, moved.least(), moved.median(), moved.most(), moved.equal_to(nominal),
                      moved.failed, moved.failed > 0 || moved.least() != moved.most());
          }
        }
        frame.progress("done", 1.0);
        frame.write(table);
      });
}
