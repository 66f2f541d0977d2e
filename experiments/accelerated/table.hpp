#pragma once
#include "accelerated/curve.hpp"
#include "accelerated/perturbed.hpp"
#include "frame/frame.hpp"
#include "frame/timing.hpp"

#include <string>
#include <vector>

/// @file
/// The experiments direct_vs_adaptive, method_comparison and p_dependence: one table of the paper each.

namespace experiment {

/// A label that gnuplot can select a curve by, such as "htvi adaptive 4 0.5".
inline std::string label_of(const Setting& s) {
  std::string label = s.method + " " + s.approach() + " " + avi::rounded(s.p);
  return s.is_direct() ? label : label + " " + avi::rounded(s.p_ring);
}

/// main() of such an experiment: every setting run to the stopping test, then from 16 starts moved by 1e-14,
/// whose range tells counts that mean something from those that the last bit decides.
inline int iteration_table(int argc, char** argv, const std::string& name, const std::string& summary,
                           const std::vector<Setting>& settings) {
  long starts = 16;
  const auto options = [&](CLI::App& app) {
    add_count(app, "--starts", starts, 1, 1000, "Starts moved by 1e-14 for each setting");
  };
  return run(argc, argv, name, summary, options, [&](Frame& frame) {
    if (frame.quick) starts = std::min(starts, 4L);
    const avi::Stopping stopping{.delta = 1e-10, .iterations = 1'000'000};
    avi::Table table = frame.table({"method", "approach", "p", "p_ring", "h", "C", "iterations",
                                    "gradient_evaluations", "converged", "perturbed_least",
                                    "perturbed_median", "perturbed_most", "perturbed_failed", "seconds"});
    table.note("delta", stopping.delta);
    table.note("perturbed", "counts from " + std::to_string(starts) + " starts moved by up to 1e-14");
    std::vector<std::string> columns{"curve", "method", "approach", "p", "p_ring"};
    for (auto& column : Curve::columns())
      columns.push_back(column);
    avi::Table curves = frame.table(columns);
    curves.note("rows", "f at the end of each bin of iterations, its least and largest value in the bin, its "
                        "largest from there on");
    const avi::CorrelatedQuartic f;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const Setting& s = settings[i];
      frame.progress(label_of(s), static_cast<double>(i) / static_cast<double>(settings.size()));
      if (frame.quick && s.is_direct() && s.p < 5) continue;
      avi::Minimisation result;
      const double time = seconds([&] { result = run_setting(s, f, f.start(), stopping); });
      PerturbedCounts counts;
      if (result.converged()) counts = perturbed_counts(s, starts, 1e-14, stopping);
      const double p_ring = s.is_direct() ? std::nan("") : s.p_ring;
      table.row(s.method, s.approach(), s.p, p_ring, s.h, s.C, result.iterations, result.gradient_evaluations,
                result.converged(), counts.least(), counts.median(), counts.most(), counts.failed,
                avi::rounded(time));
      if (!result.converged()) continue;
      Curve curve(1.0, 0.01);
      run_setting(s, f, f.start(), stopping, curve);
      curve.append(curves, {label_of(s), s.method, s.approach(), avi::exact(s.p), avi::exact(p_ring)});
    }
    frame.progress("done", 1.0);
    frame.write(curves, "curves");
    frame.write(table);
  });
}

}  // namespace experiment
