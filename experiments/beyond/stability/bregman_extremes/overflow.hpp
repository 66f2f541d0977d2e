#pragma once
#include "avi/bregman/bregman_htvi.hpp"
#include "bregman/printed/htvi_printed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

// The time at which each form of the Bregman HTVI leaves the range of double precision.

namespace experiment {

/// f = curvature |x|^2 / 2.
struct Bowl {
  double curvature;
  double operator()(const avi::VectorX& x, avi::VectorX& gradient) const {
    gradient = curvature * x;
    return 0.5 * curvature * avi::dot(x, x);
  }
};

/// The printed form as an update rule; r^t, on which nothing else depends, takes no part.
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

/// A form of the HTVI, run by hand on a bowl.
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

/// Where a form ends by its formulas: log t at which its largest coefficient reaches 1.8e308. That is
/// max(h, 1) C P t^(2p-s), t^p or eta^2 C t^p.
inline double expected_log_end(const std::string& form, const avi::BregmanFamily& family, double h) {
  const double most = std::log(std::numeric_limits<double>::max()), P = family.order(), s = family.s();
  if (form == "printed") return (most - std::log(family.C * P * std::max(h, 1.0))) / (2.0 * family.p - s);
  if (form == "momentum") return most / family.p;
  const double exponent = family.p - 2.0 * s;
  return exponent > 0.0 ? (most - 2.0 * std::log(P * h) - std::log(family.C)) / exponent : HUGE_VAL;
}

/// Fictive step that takes about `steps` steps from t = 1 to log t = `log_end`, or to 1e300 where that is
/// less.
inline double step_towards(const avi::BregmanFamily& family, double log_end, double steps) {
  return std::expm1(std::min(family.s() * log_end, 690.0)) / steps;
}

/// Curvature that keeps a^2 curvature below 3, stable, up to log t.
inline double gentle_curvature(const avi::BregmanFamily& family, double h, double log_t) {
  const double log_a = std::log(family.order() * h) + 0.5 * std::log(family.C) +
                       std::max(0.0, (0.5 * family.p - family.s()) * log_t);
  return 3.0 * std::exp(-2.0 * log_a);
}

/// Fictive step with which a form reaches its end in about `steps` steps; where it has none, one whose square
/// is far from overflow. The end depends on the step, which is to lead there: both by bisection.
inline double step_to_the_end(const std::string& form, const avi::BregmanFamily& family, double steps) {
  if (!std::isfinite(expected_log_end(form, family, 1.0))) return 1e100;
  double low = 0.0, high = 690.0 / family.s();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (expected_log_end(form, family, step_towards(family, middle, steps)) > middle ? low : high) = middle;
  }
  return step_towards(family, low, steps);
}

/// The end of one form's run.
struct End {
  std::string form;
  double h, expected, log_end;  ///< Natural logarithms of t; infinity: no end within the cap on steps.
  long steps;
};

/// Runs a form until it fails, or fifty times as long as it should last.
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

/// Largest distances of the momentum form and the heavy ball from the printed form, relative to the largest
/// |x| of the run so far, for as long as all are finite.
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
