#pragma once
#include "beyond/stability/bregman_extremes/scenes.hpp"

#include <array>
#include <limits>
#include <utility>
#include <vector>

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

/// Every method that meets the faults, with its step or rate; 0: Bregman dynamics, with the step of a scene.
inline const std::vector<std::pair<const char*, double>> fault_methods{
    {"htvi", 0.0},          {"heavy_ball", 0.0},       {"splitting", 0.0},
    {"clone_strang", 0.0},  {"clone_y4", 0.0},         {"clone_y6", 0.0},
    {"runge_kutta_4", 0.0}, {"dormand_prince", 0.0},   {"nag", 2e-6},
    {"adam", 0.1},          {"adagrad", 7.0},          {"rmsprop", 0.1},
    {"trust_region", 1.0},  {"gradient_descent", 2e-6}};

/// Runs a scene's method on a faulty objective for at most `cap` iterations.
inline Judged meet(const Scene& s, std::string_view kind, long at, long cap) {
  const FaultyQuartic f{.kind = kind, .at = at};
  Rule rule{.method = s.method, .h = s.h};
  if (s.h == 0.0) rule = {.method = s.method, .family = s.family(), .h = step_of(s), .from = s.from};
  Judged result = judge(rule, f, f.quartic.start(), cap);
  // The objective itself said that the point is stationary; no method can know better.
  if (result.outcome == "ok" && kind.starts_with("gradient_zero")) result.verdict = "told";
  return result;
}

}  // namespace experiment
