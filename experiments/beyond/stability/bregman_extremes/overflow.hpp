#pragma once
#include "avi/bregman/bregman_htvi.hpp"
#include "bregman/printed/htvi_printed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

// The time at which each form of the Bregman HTVI exceeds the range of double precision.

namespace experiment {

/// The objective f = curvature |x|^2 / 2.
struct Bowl {
  double curvature;
  double operator()(const avi::VectorX& x, avi::VectorX& gradient) const {
    gradient = curvature * x;
    return 0.5 * curvature * avi::dot(x, x);
  }
};

/// The printed form as an update rule; r^t is not needed, because nothing else depends on it.
struct PrintedHtvi {
  using State = avi::ExtendedPoint;
  avi::BregmanFamily family;
  double h;

  [[nodiscard]] State start(const avi::Iterate& first) const {
    return avi::bregman_start(family, Bowl{0.0}, first.x);
  }
  avi::Outcome update(State& z, avi::Iterate& now, const Bowl& f) const {
    htvi_printed_step(family, f, h, z);
    now.x = z.q;
    return std::isfinite(z.r[0]) ? avi::Outcome::ok : avi::Outcome::non_finite;
  }
};

/// A form of the HTVI, run step by step on a bowl.
template <class Method>
struct Form {
  Method method;
  Bowl f;
  avi::Iterate now{.x = avi::VectorX::Ones(1), .gradient = avi::VectorX::Zero(1)};
  typename Method::State state;

  Form(const avi::BregmanFamily& family, double h, const Bowl& bowl)
      : method{.family = family, .h = h}, f(bowl), state((now.evaluate(f), method.start(now))) {}
  [[nodiscard]] double log_t() const {
    if constexpr (requires { state.log_t; })
      return state.log_t;
    else
      return std::log(state.t);
  }
  [[nodiscard]] double x() const { return now.x[0]; }
  bool step() {
    if (method.update(state, now, f) != avi::Outcome::ok) return false;
    now.evaluate(f);
    return std::isfinite(x()) && std::isfinite(log_t());
  }
};

/// Predicted end of a form: log t at which its largest coefficient reaches 1.8e308. This coefficient is
/// max(h, 1) C P t^(2p-s) for the printed form, t^p for the momentum form and eta^2 C t^p for the heavy ball.
inline double expected_log_end(const std::string& form, const avi::BregmanFamily& family, double h) {
  const double most = std::log(std::numeric_limits<double>::max()), P = family.order(), s = family.s();
  if (form == "printed") return (most - std::log(family.C * P * std::max(h, 1.0))) / (2.0 * family.p - s);
  if (form == "momentum") return most / family.p;
  const double exponent = family.p - 2.0 * s;
  return exponent > 0.0 ? (most - 2.0 * std::log(P * h) - std::log(family.C)) / exponent : HUGE_VAL;
}

/// Fictive step that leads from t = 1 to log t = `log_end` in about `steps` steps; log_end is limited such
/// that t^s - 1 stays below about 1e300.
inline double step_towards(const avi::BregmanFamily& family, double log_end, double steps) {
  return std::expm1(std::min(family.s() * log_end, 690.0)) / steps;
}

/// Curvature for which a^2 curvature stays below 3, and so stable, up to log t.
inline double gentle_curvature(const avi::BregmanFamily& family, double h, double log_t) {
  const double log_a = std::log(family.order() * h) + 0.5 * std::log(family.C) +
                       std::max(0.0, (0.5 * family.p - family.s()) * log_t);
  return 3.0 * std::exp(-2.0 * log_a);
}

/// Fictive step with which a form reaches its predicted end in about `steps` steps. The end depends on the
/// step and the step on the end; both are found by bisection. For a form without an end, 1e100, whose square
/// is far from overflow.
inline double step_to_the_end(const std::string& form, const avi::BregmanFamily& family, double steps) {
  if (!std::isfinite(expected_log_end(form, family, 1.0))) return 1e100;
  double low = 0.0, high = 690.0 / family.s();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (expected_log_end(form, family, step_towards(family, middle, steps)) > middle ? low : high) = middle;
  }
  return step_towards(family, low, steps);
}

/// The end of a run of one form.
struct End {
  std::string form;
  /// The fictive step, and the end by formula and as found, as log t; infinity if there is no such end, or
  /// none within the cap on steps.
  double h, expected, log_end;
  long steps;
};

/// Runs a form until it fails, or for 50 `steps` steps at most.
template <class Method>
End run_to_its_end(const std::string& name, const avi::BregmanFamily& family, double steps) {
  const double h = step_to_the_end(name, family, steps);
  const double expected = expected_log_end(name, family, h);
  const double reach = std::isfinite(expected) ? expected : std::log(std::numeric_limits<double>::max());
  Form<Method> form(family, h, Bowl{gentle_curvature(family, h, reach)});
  End end{.form = name, .h = h, .expected = expected, .log_end = form.log_t(), .steps = 0};
  const long cap = static_cast<long>(50.0 * steps);
  while (end.steps < cap && form.step()) {
    ++end.steps;
    end.log_end = form.log_t();
  }
  if (end.steps == cap) end.log_end = HUGE_VAL;
  return end;
}

/// Largest deviations of the momentum form and the heavy ball from the printed form, relative to the largest
/// |x| of the run so far, as long as all three are finite.
struct Agreement {
  double momentum = 0.0, heavy_ball = 0.0;
  long steps = 0;
};

inline Agreement agreement(const avi::BregmanFamily& family, double steps) {
  const double h = step_to_the_end("printed", family, steps);
  const Bowl f{gentle_curvature(family, h, expected_log_end("printed", family, h))};
  Form<PrintedHtvi> printed(family, h, f);
  Form<avi::BregmanHtvi> momentum(family, h, f);
  Form<avi::BregmanHeavyBall> heavy_ball(family, h, f);
  Agreement most;
  double size = 1.0;
  while (printed.step() && momentum.step() && heavy_ball.step()) {
    ++most.steps;
    size = std::max(size, std::abs(printed.x()));
    most.momentum = std::max(most.momentum, std::abs(momentum.x() - printed.x()) / size);
    most.heavy_ball = std::max(most.heavy_ball, std::abs(heavy_ball.x() - printed.x()) / size);
  }
  return most;
}

}  // namespace experiment
