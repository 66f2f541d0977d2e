#pragma once
#include "beyond/stability/bregman_extremes/limits.hpp"

#include "avi/problems/correlated_quartic.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

/// @file
/// Minimisations at the extremes, each judged: correct, ended with a named outcome, or silently wrong.

namespace experiment {

/// One run.
struct Scene {
  std::string scene;  ///< What is extreme: order, conditioning, dimension, start, clock, step or fault.
  std::string method;
  double p = 4.0, p_ring = 1.0;
  double h = 0.0;  ///< Fictive step; 0: 0.3 of the linear limit at the start.
  Eigen::Index dimension = 50;
  double rho = 0.9;
  double away = 4.0;  ///< Distance of every entry of x0 from the minimiser.
  avi::BregmanStart from{};
  double C = 0.0625;
  long cap = 100'000;

  [[nodiscard]] avi::BregmanFamily family() const { return avi::BregmanFamily::adaptive(p, p_ring, C); }
};

/// Largest eigenvalue of the quartic's Hessian at x0 = 1 + away, from above:
/// 4 q Sigma + 8 (Sigma y)(Sigma y)^T with q = y^T Sigma y.
inline double curvature_at_start(const Scene& s) {
  // From nearby, the momentum r0 = 1 first leads away.
  const avi::VectorX y = avi::VectorX::Constant(s.dimension, std::max(s.away, 1.0));
  avi::VectorX image(s.dimension);
  avi::multiply_by_correlation(s.rho, y, image);
  const double rho = std::abs(s.rho);
  const double largest = std::min(static_cast<double>(s.dimension), (1.0 + rho) / (1.0 - rho));
  return 4.0 * avi::dot(y, image) * largest + 8.0 * avi::dot(image, image);
}

/// The step that a scene asks for.
inline double step_of(const Scene& s) {
  if (s.h != 0.0) return s.h;
  const auto family = s.family();
  const double at_start = std::pow(s.from.t, 0.5 * family.p - family.s());
  return 0.3 * linear_limit(s.method) /
         (family.order() * at_start * std::sqrt(family.C * curvature_at_start(s)));
}

/// How a run ended, for the table.
struct Judged {
  std::string outcome{};  ///< Of the run, or `refused` with its sentence.
  std::string verdict{};  ///< correct, named, told or silent.
  double h = 0.0;
  long iterations = 0;
  double value = std::nan("");
  std::string message{};
};

/// A run that says it converged must hold up: finite, and the criterion true when f is asked again.
template <class F>
std::string verdict_of(const avi::Minimisation& run, const F& f, double delta) {
  if (run.outcome != avi::Outcome::ok) return run.message.empty() ? "silent" : "named";
  avi::VectorX gradient(run.last.x.size());
  const double value = f(run.last.x, gradient);
  return run.last.x.allFinite() && std::isfinite(value) && avi::norm(gradient) < delta ? "correct" : "silent";
}

/// Calls run(), which makes a Minimisation of f, and judges it.
template <class Run, class F>
Judged judge(const F& f, double delta, Run&& run) {
  Judged result;
  try {
    const avi::Minimisation end = run();
    result.outcome = name(end.outcome);
    result.verdict = verdict_of(end, f, delta);
    result.iterations = end.iterations;
    result.value = end.last.value;
    result.message = end.message;
  } catch (const std::invalid_argument& refused) {
    result.outcome = "refused";
    result.verdict = std::string_view(refused.what()).empty() ? "silent" : "named";
    result.message = refused.what();
  }
  return result;
}

/// Runs a scene on the paper's quartic to delta = 1e-10.
inline Judged play(const Scene& s) {
  const avi::Stopping stopping{.delta = 1e-10, .iterations = s.cap};
  const avi::CorrelatedQuartic f(s.dimension, s.rho);
  const double h = step_of(s);
  Judged result = judge(f, stopping.delta, [&] {
    return run_updates({.method = s.method, .family = s.family(), .h = h, .from = s.from}, f,
                       f.minimiser().array() + s.away, stopping);
  });
  result.h = h;
  return result;
}

}  // namespace experiment
