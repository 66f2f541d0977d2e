#pragma once
#include "beyond/stability/bregman_extremes/limits.hpp"
#include "common/problems/correlated_quartic.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// Minimisations at the extremes. Each is judged: correct, ended with a named outcome, or silently wrong.

namespace experiment {

/// One run.
struct Scene {
  std::string scene;  ///< What is extreme: order, conditioning, dimension, start, clock, step or fault.
  std::string method;
  double p = 4.0, p_ring = 1.0;
  double h = 0.0;  ///< Fictive step; 0 for 0.3 times the linear limit at the start.
  Eigen::Index dimension = 50;
  double rho = 0.9;
  double away = 4.0;  ///< Distance of every entry of x0 from the minimiser.
  avi::BregmanStart from{};
  double C = 0.0625;
  long cap = 100'000;

  [[nodiscard]] avi::BregmanFamily family() const { return avi::BregmanFamily::adaptive(p, p_ring, C); }
};

/// Upper bound on the largest eigenvalue of the quartic's Hessian at x0 = 1 + away, 4 q Sigma + 8 (Sigma
/// y)(Sigma y)^T with q = y^T Sigma y.
inline double curvature_at_start(const Scene& s) {
  // For a start near the minimum, the momentum r0 = 1 first leads away from it.
  const avi::VectorX y = avi::VectorX::Constant(s.dimension, std::max(s.away, 1.0));
  avi::VectorX image(s.dimension);
  multiply_by_correlation(s.rho, y, image);
  const double rho = std::abs(s.rho);
  const double largest = std::min(static_cast<double>(s.dimension), (1.0 + rho) / (1.0 - rho));
  return 4.0 * avi::dot(y, image) * largest + 8.0 * avi::dot(image, image);
}

/// The fictive step of a scene.
inline double step_of(const Scene& s) {
  if (s.h != 0.0) return s.h;
  const auto family = s.family();
  const double at_start = std::pow(s.from.t, 0.5 * family.p - family.s());
  return 0.3 * linear_limit(s.method) /
         (family.order() * at_start * std::sqrt(family.C * curvature_at_start(s)));
}

/// How a run ended, for the table.
struct Judged {
  std::string outcome{};  ///< Outcome of the run, or `refused`.
  std::string verdict{};  ///< One of correct, named, told, silent.
  long iterations = 0;
  double value = std::nan("");
};

/// The verdict on a run. One that claims to have converged must be finite, and the criterion must hold when f
/// is evaluated again.
std::string verdict_of(const avi::Minimisation& run, const auto& f, double delta) {
  if (run.outcome != avi::Outcome::ok) return run.message.empty() ? "silent" : "named";
  avi::VectorX gradient(run.last.x.size());
  const double value = f(run.last.x, gradient);
  return run.last.x.allFinite() && std::isfinite(value) && avi::norm(gradient) < delta ? "correct" : "silent";
}

/// Minimises f to delta = 1e-10 and judges the run.
Judged judge(const Rule& rule, const auto& f, const avi::VectorX& x0, long cap) {
  const avi::Stopping stopping{.delta = 1e-10, .iterations = cap};
  try {
    const avi::Minimisation end = run_updates(rule, f, x0, stopping);
    return {std::string(name(end.outcome)), verdict_of(end, f, stopping.delta), end.iterations,
            end.last.value};
  } catch (const std::invalid_argument& refused) {
    return {"refused", std::string_view(refused.what()).empty() ? "silent" : "named"};
  }
}

/// Runs a scene on the paper's quartic with step h.
inline Judged play(const Scene& s, double h) {
  const CorrelatedQuartic f(s.dimension, s.rho);
  return judge({.method = s.method, .family = s.family(), .h = h, .from = s.from}, f,
               f.minimiser().array() + s.away, s.cap);
}

inline constexpr const char* bregman_methods[] = {"htvi",     "heavy_ball", "splitting",    "clone_strang",
                                                  "clone_y4", "clone_y6",   "runge_kutta_4"};

/// All scenes, in the order of the table.
inline std::vector<Scene> plan(bool quick) {
  std::vector<Scene> all;
  // Every method, p to 50, p_ring to 1e-6: P = p^2/p_ring to 2.5e9.
  for (const char* method : bregman_methods)
    for (double p : {1.0, 2.0, 4.0, 10.0, 20.0, 50.0})
      for (double p_ring : std::set{p, 1.0, 1e-3, 1e-6})
        if (p_ring <= p) {
          Scene s{.scene = "order", .method = method, .p = p, .p_ring = p_ring};
          // At low orders a run would need more iterations than is useful here.
          s.cap = quick ? 1000 : p * p / p_ring < 10.0 ? 5000 : 25'000;
          all.push_back(s);
        }
  for (const char* method : {"htvi", "heavy_ball"})
    for (double p : {4.0, 10.0}) {
      const auto add = [&](const char* scene, const auto& change) {
        Scene s{.scene = scene, .method = method, .p = p, .p_ring = p == 4.0 ? 1.0 : 0.5};
        s.cap = quick ? 2000 : 100'000;
        change(s);
        all.push_back(s);
      };
      for (int k = 1; k <= 8; ++k)
        add("conditioning", [&](Scene& s) { s.rho = 1.0 - std::pow(10.0, -k); });
      // Large dimensions, with a cap on the number of entries moved.
      const long largest = quick ? 10'000 : 1'000'000;
      for (long n : {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 10'000, 100'000, 1'000'000}) {
        const long entries = quick ? 200'000 : n > 200 ? 4'000'000 : 20'000'000;
        if (n <= largest)
          add("dimension", [&](Scene& s) {
            s.dimension = n;
            s.cap = std::clamp(entries / n, 10L, 400'000L);
          });
      }
      // Starts at other distances: first as they are, then with C away^2 and r0 / away unchanged. Because f
      // is homogeneous, a far start then has the run of a near one, with a relatively smaller delta.
      for (int k = -6; k <= 6; ++k) {
        const double away = std::pow(10.0, k);
        add("start", [&](Scene& s) { s.away = away; });
        add("start_scaled", [&](Scene& s) {
          s.away = away;
          s.C *= 16.0 / (away * away);
          s.from.momentum = away / 4.0;
        });
      }
      // Unreasonable start times and steps.
      for (double t : {1e-6, 1e-3, 1e3, 1e6, 1e30, 1e100})
        add("clock", [&](Scene& s) { s.from = {.t = t, .momentum = 0.0}; });
      for (double h : {1e-300, 1e-20, 1.0, 1e20, 1e300})
        add("step", [&](Scene& s) { s.h = h; });
    }
  return all;
}

}  // namespace experiment
