#include "bregman/table.hpp"

#include "common/timing.hpp"

#include <random>

namespace experiment {

std::string label_of(const Setting& s) {
  const std::string label = s.method + " " + s.approach() + " " + rounded(s.p);
  return s.is_direct() ? label : label + " " + rounded(s.p_ring);
}

void iteration_table(Frame& frame, const std::vector<Setting>& settings) {
  const long starts = frame.quick ? 4 : 16;
  const avi::Stopping stopping{.delta = 1e-10, .iterations = 1'000'000};
  Table& table =
      frame.table({"method", "approach", "p", "p_ring", "h", "C", "iterations", "gradient_evaluations",
                   "converged", "perturbed_least", "perturbed_most", "perturbed_failed", "seconds"});
  table.note("delta", stopping.delta);
  table.note("perturbed", "counts from " + std::to_string(starts) + " starts moved by up to 1e-14");
  Table& curves = frame.table("curves", Curve::columns_after({"curve", "method", "approach", "p", "p_ring"}));
  curves.note("rows", Curve::rows);
  const CorrelatedQuartic f;
  each_setting(frame, settings, [&](const Setting& s, bool) {
    avi::Minimisation result;
    Curve curve(1.0, 0.01);
    const double time = seconds([&] { result = run_setting(s, f, f.start(), stopping, curve); });
    PerturbedCounts counts;
    if (result.ok()) counts = perturbed_counts(s, starts, 1e-14, stopping);
    table.row(s.method, s.approach(), s.p, s.p_ring_or_nan(), s.h, s.family().C, result.iterations,
              result.gradient_evaluations, result.ok(), counts.least(), counts.most(), counts.failed,
              rounded(time));
    if (result.ok())
      curve.append(curves, {label_of(s), s.method, s.approach(), exact(s.p), exact(s.p_ring_or_nan())});
  });
}

PerturbedCounts perturbed_counts(const Setting& setting, long starts, double size,
                                 const avi::Stopping& stopping) {
  const CorrelatedQuartic f;
  PerturbedCounts result;
  for (long i = 0; i < starts; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(i) + 1);
    avi::VectorX x0 = f.start();
    for (double& x : x0)  // 53 bits of the generator, mapped to [-1, 1): the same on every platform
      x += size * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0);
    const auto run = run_setting(setting, f, x0, stopping);
    if (run.ok())
      result.counts.push_back(run.iterations);
    else
      ++result.failed;
  }
  std::ranges::sort(result.counts);
  return result;
}

void each_setting(const Frame& frame, const std::vector<Setting>& settings,
                  const std::function<void(const Setting&, bool slow)>& visit) {
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Setting& s = settings[i];
    frame.progress(label_of(s), i, settings.size());
    const bool slow = s.is_direct() && s.p < 5;
    if (!slow || !frame.quick) visit(s, slow);
  }
}

}  // namespace experiment
