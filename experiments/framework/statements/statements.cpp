#include "avi/diagnostics/symplecticity.hpp"
#include "common/frame.hpp"
#include "common/power_law.hpp"
#include "framework/statements/curve.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

// What the appendix and Section 3.2 of the paper state without a number: powers of h by which errors fall, at
// a point of phase space where the p-Hessian of H-bar is singular and at a regular one, and symplecticity on
// extended phase space.

namespace {

using namespace experiment::statements;

constexpr double monitor = -0.25;  ///< c in g = 2 + q^2/2 + c p^2.
constexpr double q_start = 0.4;

/// Momentum at which g H_pp + 2 H_p g_p = g + 4 c p^2 vanishes on the energy shell.
double singular_momentum() { return std::sqrt((2.0 + 0.5 * q_start * q_start) / (-5.0 * monitor)); }

Point start(bool singular) {
  const double p = singular ? singular_momentum() : 1.0;
  return {q_start, 0.0, p, -Field<double>{monitor}.h(q_start, p)};
}

/// Zero of an increasing function near x by the secant method.
double root(const std::function<double(double)>& f, double x) {
  double a = x, b = x + 1e-4, fa = f(a), fb = f(b);
  for (int k = 0; k < 60 && fb != fa && std::abs(b - a) > 1e-17; ++k) {
    const double next = b - fb * (b - a) / (fb - fa);
    a = b, fa = fb, b = next, fb = f(b);
  }
  return b;
}

/// Power by which error(h) falls, over the last eight values above round-off; NaN with fewer than four.
avi::DriftFit fitted(const std::function<double(double)>& error, double from) {
  std::vector<double> steps, errors;
  for (double h = from; h > from / 40.0; h *= 0.8)
    if (const double e = error(h); e > 3e-14 && e < 0.1) {
      steps.push_back(h);
      errors.push_back(e);
    }
  if (steps.size() < 4) return {.slope = std::nan("")};
  const auto left = std::min<std::ptrdiff_t>(8, std::ssize(steps));
  return experiment::power_law({steps.end() - left, steps.end()}, {errors.end() - left, errors.end()});
}

}  // namespace

void experiment::conduct(Frame& frame) {
  experiment::Table& table = frame.table({"statement", "hessian", "r", "expected", "measured", "points"});
  table.note("problem", "H = p^2/2 + q^2/2 + q^4/4, g = 2 + q^2/2 - p^2/4, one step");
  table.note("hessian", "whether the p-Hessian of H-bar vanishes at the start");
  for (const bool singular : {false, true}) {
    const Point z = start(singular);
    const double q0 = z[0], p0 = z[2], pt = z[3];
    const auto from = [&](double q, double p) { return Curve<double>(q, p, pt, monitor); };
    const Curve<double> exact = from(q0, p0);
    const std::string hessian = singular ? "singular" : "regular";
    const auto add = [&](const char* name, int r, double expected, double largest_h,
                         const std::function<double(double)>& error) {
      const auto fit = fitted(error, largest_h);
      table.row(name, hessian, r, expected, fit.slope, fit.points);
    };
    for (int r : {1, 2, 3}) {
      const auto p_tilde = [&](double h) {
        return root([&](double u) { return from(q0, u).p.at(h, r) - exact.p.at(h, most); }, p0);
      };
      const auto q_tilde = [&](double h) {
        return root([&](double x) { return from(x, p0).q.at(h, r + 1) - exact.q.at(h, most); }, q0);
      };
      add("p~0 - p0", r, r + 1, 0.2, [&](double h) { return std::abs(p_tilde(h) - p0); });
      add("q~0 - q0", r, r + 2, 0.2, [&](double h) { return std::abs(q_tilde(h) - q0); });
      add("q~1 - q1", r, r + 2, 0.2,
          [&](double h) { return std::abs(from(q0, p_tilde(h)).q.at(h, r + 1) - exact.q.at(h, most)); });
      add("Taylor curve", r, r + 1, 0.2, [&](double h) {
        const Curve<double> curve = from(q0, p_tilde(h));
        double worst = 0.0;
        for (int k = 1; k <= 8; ++k) {
          const double tau = 0.125 * k * h;
          worst = std::max({worst, std::abs(curve.q.at(tau, r) - exact.q.at(tau, most)),
                            std::abs(curve.p.at(tau, r) - exact.p.at(tau, most))});
        }
        return worst;
      });
      for (const bool stationary : {false, true})
        add(stationary ? "stationary step" : "printed step", r, (stationary ? 2 * r + 2 : r + 1) + 1, 0.25,
            [&](double h) {
              const Point end = type2_step(z, h, r, gauss(r + 1), stationary, monitor);
              return std::max({std::abs(end[0] - exact.q.at(h, most)), std::abs(end[1] - exact.t.at(h, most)),
                               std::abs(end[2] - exact.p.at(h, most))});
            });
    }
    // How the end of the exact solution moves with p0.
    const auto ahead = from(q0, p0 + 1e-5), behind = from(q0, p0 - 1e-5);
    add("dq1/dp0", 0, singular ? 2 : 1, 0.02,
        [&](double h) { return std::abs(ahead.q.at(h, most) - behind.q.at(h, most)) / 2e-5; });
    add("dp1/dp0 - 1", 0, 1, 0.02,
        [&](double h) { return std::abs((ahead.p.at(h, most) - behind.p.at(h, most)) / 2e-5 - 1.0); });
    double defect = 0.0;
    for (const bool stationary : {false, true})
      for (int r : {1, 2, 3}) {
        const auto step = [&](const avi::VectorX& w) -> avi::VectorX {
          const Point end = type2_step({w[0], w[1], w[2], w[3]}, 0.05, r, gauss(r + 1), stationary, monitor);
          return Eigen::Vector4d(end.data());
        };
        defect = std::max(
            defect, avi::symplecticity_defect(step, Eigen::Vector4d(z.data()), {1.0 / 64.0, 1.0 / 64.0}));
      }
    table.row("extended symplecticity", hessian, 0, 0.0, defect, 6);
  }
}
