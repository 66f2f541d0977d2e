#pragma once
#include "beyond/stability/bregman_extremes/scenes.hpp"

#include <array>
#include <limits>
#include <map>

/// @file
/// Objectives that fail while a run is on.

namespace experiment {

/// What goes wrong at one evaluation. The value and the gradient are otherwise the quartic's.
inline constexpr std::array<std::string_view, 10> fault_kinds{
    "value_nan",     "value_inf",     "value_minus_inf",        "gradient_nan",  "gradient_inf",
    "gradient_huge", "gradient_zero", "gradient_zero_for_good", "one_entry_nan", "nan_swallowed"};

/// The paper's quartic with a fault at its evaluation number `at`.
struct FaultyQuartic {
  std::string_view kind;
  long at;
  avi::CorrelatedQuartic quartic{};
  mutable long calls = 0;

  double operator()(const avi::VectorX& x, avi::VectorX& gradient) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     inf = std::numeric_limits<double>::infinity();
    const bool now = ++calls == at;
    if (kind == "nan_swallowed" && !x.allFinite()) return gradient.setZero(x.size()), 0.0;
    double value = quartic(x, gradient);
    if (calls > at && kind == "gradient_zero_for_good") gradient.setZero();
    if (!now) return value;
    if (kind == "value_nan") value = nan;
    if (kind == "value_inf") value = inf;
    if (kind == "value_minus_inf") value = -inf;
    if (kind == "gradient_nan" || kind == "nan_swallowed") gradient.setConstant(nan);
    if (kind == "gradient_inf") gradient.setConstant(inf);
    if (kind == "gradient_huge") gradient.setConstant(1e300);
    if (kind == "one_entry_nan") gradient[gradient.size() / 2] = nan;
    if (kind.starts_with("gradient_zero")) gradient.setZero();
    return value;
  }
};

/// Every method that meets the faults.
inline constexpr std::array<const char*, 14> fault_methods{
    "htvi",          "heavy_ball",      "splitting", "clone_strang", "clone_y4", "clone_y6",
    "runge_kutta_4", "dormand_prince",  "nag",       "adam",         "adagrad",  "rmsprop",
    "trust_region",  "gradient_descent"};

/// That method, Adaptive (10, 0.5) where it is one of Bregman dynamics.
inline Rule rule_that_meets_faults(const std::string& method) {
  const std::map<std::string, double> sizes{{"nag", 2e-6},         {"adam", 0.1},
                                            {"adagrad", 7.0},      {"rmsprop", 0.1},
                                            {"trust_region", 1.0}, {"gradient_descent", 2e-6}};
  if (const auto size = sizes.find(method); size != sizes.end()) return {.method = method, .h = size->second};
  const Scene scene{.scene = "fault", .method = method, .p = 10.0, .p_ring = 0.5};
  return {.method = method, .family = scene.family(), .h = step_of(scene), .from = scene.from};
}

/// Runs a method on a faulty objective for at most `cap` iterations.
inline Judged meet(const std::string& method, std::string_view kind, long at, long cap) {
  const FaultyQuartic f{.kind = kind, .at = at};
  Judged result = judge(rule_that_meets_faults(method), f, f.quartic.start(), cap);
  // The objective itself said that the point is stationary; no method can know better.
  if (result.outcome == "ok" && kind.starts_with("gradient_zero")) result.verdict = "told";
  return result;
}

}  // namespace experiment
