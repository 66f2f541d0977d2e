#include "bregman/table.hpp"
#include "common/timing.hpp"

// Iterations as a function of the step: each published step compared with all two-digit steps between 0.6 and
// 1.3 times its value.

namespace {

using namespace experiment;

/// All two-digit numbers in [low, high], from 1e-6 to 0.99.
std::vector<double> two_digit_numbers(double low, double high) {
  std::vector<double> numbers;
  for (int e = -7; e <= -2; ++e)
    for (int m = 10; m < 100; ++m) {
      const double h = m * std::pow(10.0, e);
      if (h >= low * (1.0 - 1e-9) && h <= high * (1.0 + 1e-9)) numbers.push_back(h);
    }
  return numbers;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table = frame.table(
      {"method", "approach", "p", "p_ring", "h", "iterations", "least", "median", "most", "printed_is_best"});
  table.note("grid", "two-digit steps from 0.6 to 1.3 times the published one");
  Table& grid = frame.table(
      "grid", {"row", "method", "approach", "p", "p_ring", "h", "relative_h", "iterations", "converged"});
  const CorrelatedQuartic f;
  const avi::Stopping stopping{.delta = 1e-10, .iterations = 400'000};
  each_setting(frame, all_settings(), [&](const Setting& s, bool slow) {
    if (slow && s.method.starts_with("clone_y")) return;  // a whole grid of long runs would take too long
    const long printed = run_setting(s, f, f.start(), stopping).iterations;
    std::vector<double> counts;
    bool best = true;
    for (double h : two_digit_numbers(0.6 * s.h, 1.3 * s.h)) {
      Setting other = s;
      other.h = h;
      const auto result = run_setting(other, f, f.start(), stopping);
      const double iterations = result.ok() ? result.iterations : unknown;
      grid.row(label_of(s), s.method, s.approach(), s.p, s.p_ring_or_nan(), h, h / s.h, iterations,
               result.ok());
      if (!result.ok()) continue;
      counts.push_back(iterations);
      best &= result.iterations >= printed || std::abs(h / s.h - 1.0) <= 1e-9;
    }
    std::ranges::sort(counts);
    table.row(s.method, s.approach(), s.p, s.p_ring_or_nan(), s.h, printed, counts.front(), median(counts),
              counts.back(), best);
  });
}
