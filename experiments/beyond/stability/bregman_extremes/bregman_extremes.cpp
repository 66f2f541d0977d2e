#include "beyond/stability/bregman_extremes/scenes.hpp"
#include "common/frame.hpp"
#include "common/timing.hpp"

#include <array>
#include <utility>

// Bregman dynamics at its limits: the time at which each form of the HTVI overflows; the largest stable step
// of every method; and minimisations with extreme orders, conditions, dimensions, starts, clocks and steps,
// and with objectives that fail. No run may end with a wrong result that looks right.

namespace {

using namespace experiment;
using Orders = std::vector<std::pair<double, double>>;  // (p, p_ring)

/// A fault at one evaluation. Otherwise value and gradient are those of the quartic.
constexpr std::array<std::string_view, 10> fault_kinds{
    "value_nan",     "value_inf",     "value_minus_inf",        "gradient_nan",  "gradient_inf",
    "gradient_huge", "gradient_zero", "gradient_zero_for_good", "one_entry_nan", "nan_swallowed"};

/// The paper's quartic with a fault at evaluation number `at`.
struct FaultyQuartic {
  std::string_view kind;
  long at;
  CorrelatedQuartic quartic{};
  mutable long calls = 0;

  double operator()(const avi::VectorX& x, avi::VectorX& gradient) const {
    const bool now = ++calls == at;
    if (kind == "nan_swallowed" && !x.allFinite()) return gradient.setZero(x.size()), 0.0;
    double value = quartic(x, gradient);
    if (calls > at && kind == "gradient_zero_for_good") gradient.setZero();
    if (!now) return value;
    if (kind == "value_nan") value = unknown;
    if (kind == "value_inf") value = HUGE_VAL;
    if (kind == "value_minus_inf") value = -HUGE_VAL;
    if (kind == "gradient_nan" || kind == "nan_swallowed") gradient.setConstant(unknown);
    if (kind == "gradient_inf") gradient.setConstant(HUGE_VAL);
    if (kind == "gradient_huge") gradient.setConstant(1e300);
    if (kind == "one_entry_nan") gradient[gradient.size() / 2] = unknown;
    if (kind.starts_with("gradient_zero")) gradient.setZero();
    return value;
  }
};

/// Every method that is tested with faults, with its step or rate; 0 for Bregman dynamics, which uses the
/// step of a scene.
const std::vector<std::pair<const char*, double>> fault_methods{
    {"htvi", 0.0},          {"heavy_ball", 0.0},       {"splitting", 0.0},
    {"clone_strang", 0.0},  {"clone_y4", 0.0},         {"clone_y6", 0.0},
    {"runge_kutta_4", 0.0}, {"dormand_prince", 0.0},   {"nag", 2e-6},
    {"adam", 0.1},          {"adagrad", 7.0},          {"rmsprop", 0.1},
    {"trust_region", 1.0},  {"gradient_descent", 2e-6}};

/// Runs a scene's method on a faulty objective for at most `cap` iterations.
Judged meet(const Scene& s, std::string_view kind, long at, long cap) {
  const FaultyQuartic f{.kind = kind, .at = at};
  Rule rule{.method = s.method, .h = s.h};
  if (s.h == 0.0) rule = {.method = s.method, .family = s.family(), .h = step_of(s), .from = s.from};
  Judged result = judge(rule, f, f.quartic.start(), cap);
  // The objective itself declared the point stationary; no method can know better.
  if (result.outcome == "ok" && kind.starts_with("gradient_zero")) result.verdict = "told";
  return result;
}

void write_overflow(Frame& frame) {
  Table& table = frame.table("overflow", {"form", "p", "p_ring", "h", "log10_t_end", "log10_t_expected",
                                          "steps", "distance_from_printed", "steps_compared"});
  table.note("distance_from_printed", "largest |x - x_printed| / |x| while both are finite");
  const double steps = 2000.0;
  Orders orders;
  for (double p : {2, 3, 4, 6, 8, 10, 20, 35, 50})
    orders.emplace_back(p, p);
  orders.insert(orders.end(), {{2, 1e-3}, {4, 1}, {10, 0.5}, {50, 1}, {50, 1e-3}, {50, 1e-6}});
  for (const auto& [p, p_ring] : orders) {
    const auto family = avi::BregmanFamily::adaptive(p, p_ring);
    const Agreement close = agreement(family, steps);
    // clang++ 14 cannot capture a structured binding without an initialiser.
    const auto add = [&, p = p, p_ring = p_ring](const End& end, double distance) {
      table.row(end.form, p, p_ring, end.h, end.log_end / M_LN10, end.expected / M_LN10, end.steps, distance,
                close.steps);
    };
    add(run_to_its_end<PrintedHtvi>("printed", family, steps), 0.0);
    add(run_to_its_end<avi::BregmanHtvi>("momentum", family, steps), close.momentum);
    add(run_to_its_end<avi::BregmanHeavyBall>("heavy_ball", family, steps), close.heavy_ball);
  }
}

void write_limits(Frame& frame) {
  Table& table = frame.table("limits", {"method", "p", "p_ring", "t_end", "h_expected", "h_measured", "ratio",
                                        "beyond_outcome", "beyond_iterations", "beyond_message"});
  table.note("objective", "|x|^2 / 2, C = 1e9; stable: f stays below 1000 f(x0) from t = 1 to t_end");
  table.note("beyond", "the run with 1.05 times the measured step, under the default bounds");
  Orders orders = {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {6, 6}, {10, 10}, {4, 1}};
  if (!frame.quick) orders.insert(orders.end(), {{20, 20}, {35, 35}, {50, 50}, {50, 1e-6}});
  for (const char* method : bregman_methods)
    for (const auto& [p, p_ring] : orders) {
      const double T = 1.01;
      const Limit limit = largest_stable_step(method, p, p_ring, T);
      table.row(method, p, p_ring, T, limit.expected, limit.measured, limit.measured / limit.expected,
                name(limit.beyond.outcome), limit.beyond.iterations, limit.beyond.message);
    }
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table =
      frame.table({"scene", "method", "p", "p_ring", "h", "C", "dimension", "one_less_rho", "away", "t0",
                   "fault", "fault_at", "iterations", "value", "outcome", "verdict", "seconds"});
  table.note("verdict", "correct: converged, and asked again the criterion holds; named: any other "
                        "outcome, with a sentence; told: the objective itself reported a zero gradient");
  const auto add = [&](const Scene& s, double h, std::string_view fault, long at, const auto& play_it) {
    Judged end;
    const double time = seconds([&] { end = play_it(); });
    table.row(s.scene, s.method, s.p, s.p_ring, h, s.C, s.dimension, 1.0 - s.rho, s.away, s.from.t, fault,
              static_cast<double>(at), end.iterations, end.value, end.outcome, end.verdict, rounded(time, 3));
  };
  frame.progress("overflow", 0.0);
  write_overflow(frame);
  frame.progress("limits", 0.1);
  write_limits(frame);
  const auto all = plan(frame.quick);
  for (std::size_t i = 0; i < all.size(); ++i) {
    frame.progress(all[i].scene, 0.2 + 0.7 * i / all.size());
    const double h = step_of(all[i]);
    add(all[i], h, "none", 0, [&] { return play(all[i], h); });
  }
  frame.progress("faults", 0.9);
  for (const auto& [method, h] : fault_methods)
    for (std::string_view kind : fault_kinds)
      for (long at : {1L, 2L, 10L, 100L}) {
        const Scene s{.scene = "fault", .method = method, .p = 10.0, .p_ring = 0.5, .h = h};
        add(s, 0.0, kind, at, [&] { return meet(s, kind, at, frame.quick ? 1000 : 15'000); });
      }
}
