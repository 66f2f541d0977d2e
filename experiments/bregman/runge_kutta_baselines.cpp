#include "beyond/counts/sustained.hpp"
#include "bregman/curve.hpp"
#include "bregman/setting.hpp"
#include "common/frame.hpp"
#include "common/timing.hpp"

// The non-symplectic baselines at p = 10, p_ring = 0.5: the classical Runge-Kutta method over fixed steps,
// embedded pairs over tolerances, ours and GSL's, beside HTVI at its published steps.

void experiment::conduct(Frame& frame) {
  constexpr double atol = 1e-6;
  const CorrelatedQuartic f;
  const avi::Stopping stopping{.delta = 1e-10, .iterations = 400'000};
  Table& table = frame.table({"method", "approach", "p", "p_ring", "rtol", "atol", "h", "iterations",
                              "gradient_evaluations", "converged", "outcome", "seconds", "sustained"});
  Table& curves = frame.table("curves", Curve::columns_after({"curve", "method", "approach"}));
  table.note("delta", stopping.delta);
  table.note("sustained",
             "first iteration from which the stopping test holds until the run is twice as long");
  table.note("rtol, atol", "nan where the step is fixed; then h is the step");
  curves.note("rows", Curve::rows);
  double done = 0.0;
  for (const auto& family : {avi::BregmanFamily::direct(10), avi::BregmanFamily::adaptive(10, 0.5)}) {
    const std::string approach = family.is_direct() ? "direct" : "adaptive";
    const auto add = [&](const std::string& name, double rtol, double h, bool shown) {
      const Rule rule{.method = name, .family = family, .h = h, .control = {.rtol = rtol, .atol = atol}};
      frame.progress(name, done += 1.0 / 52.0);
      avi::Minimisation result;
      Curve curve(1.0, 0.01);
      const double time = seconds([&] { result = run_updates(rule, f, f.start(), stopping, curve); });
      Sustained seen{.cap = 50 * result.iterations};
      if (result.ok()) run_updates(rule, f, f.start(), {.delta = 0.0, .iterations = seen.cap}, seen);
      table.row(name, approach, family.p, family.is_direct() ? unknown : family.p_ring, rtol,
                std::isnan(rtol) ? unknown : atol, h, result.iterations, result.gradient_evaluations,
                result.ok(), avi::name(result.outcome), rounded(time),
                seen.confirmed ? seen.sustained() : unknown);
      if (shown) curve.append(curves, {name + " " + approach, name, approach});
    };
    const double published = family.is_direct() ? 4e-4 : 1.95e-5;
    add("htvi", unknown, published, true);
    for (double factor : {0.25, 0.5, 1.0, 2.0, 4.0})
      add("runge_kutta_4", unknown, factor * published, factor == 1.0);
    for (double rtol : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {  // 1e-3 and atol: the defaults of MATLAB's solvers
      if (frame.quick && rtol < 1e-3) continue;
      for (const char* pair : {"dormand_prince", "bogacki_shampine"})
        add(pair, rtol, unknown, rtol == 1e-3);
      for (const char* peer : {"gsl_rkf45", "gsl_rk8pd"})
        add(peer, rtol, unknown, false);
    }
  }
}
