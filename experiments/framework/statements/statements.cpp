#include "common/frame.hpp"
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

/// Power by which error(h) falls: least squares in logarithms over values above round-off.
struct Fit {
  double power = std::nan("");
  int points = 0;
};
Fit fitted(const std::function<double(double)>& error, double from) {
  std::vector<std::pair<double, double>> seen;
  for (double h = from; h > from / 40.0; h *= 0.8)
    if (const double e = error(h); e > 3e-14 && e < 0.1) seen.emplace_back(std::log(h), std::log(e));
  if (seen.size() < 4) return {};
  seen.erase(seen.begin(),
             seen.end() - std::min<std::ptrdiff_t>(8, static_cast<std::ptrdiff_t>(seen.size())));
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(seen.size());
  for (const auto& [a, b] : seen)
    x += a / n, y += b / n;
  for (const auto& [a, b] : seen)
    xx += (a - x) * (a - x), xy += (a - x) * (b - y);
  return {xy / xx, static_cast<int>(seen.size())};
}

/// |J^T Omega J - Omega| of a step on (q, t, p, p^t), by central differences.
double extended_defect(const Point& z, const std::function<Point(const Point&)>& step) {
  std::array<Point, 4> column{};
  constexpr double by = 1e-4;
  for (std::size_t j = 0; j < 4; ++j) {
    const auto moved = [&](double k) {
      Point w = z;
      w[j] += k * by;
      return step(w);
    };
    const Point a = moved(1), b = moved(-1), c = moved(2), d = moved(-2);
    for (std::size_t i = 0; i < 4; ++i)
      column[j][i] = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * by);
  }
  double most_off = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 2; ++k)
        sum += column[i][k] * column[j][k + 2] - column[i][k + 2] * column[j][k];
      const double omega = j == i + 2 ? 1.0 : i == j + 2 ? -1.0 : 0.0;
      most_off = std::max(most_off, std::abs(sum - omega));
    }
  return most_off;
}

}  // namespace

int main(int argc, char** argv) {
  return experiment::run(
      argc, argv, "statements", "Powers of h that the appendix and Section 3.2 state",
      [](experiment::Frame& frame) {
        experiment::Table table =
            frame.table({"statement", "hessian", "r", "expected", "measured", "points"});
        table.note("problem", "H = p^2/2 + q^2/2 + q^4/4, g = 2 + q^2/2 - p^2/4, one step");
        table.note("hessian", "whether the p-Hessian of H-bar vanishes at the start");
        for (const bool singular : {false, true}) {
          const Point z = start(singular);
          const double q0 = z[0], p0 = z[2], pt = z[3];
          const Curve<double> exact(q0, p0, pt, monitor);
          const std::string hessian = singular ? "singular" : "regular";
          const auto add = [&](const char* name, int r, double expected,
                               const std::function<double(double)>& error, double from) {
            const Fit fit = fitted(error, from);
            table.row(name, hessian, r, expected, fit.power, fit.points);
          };
          const auto p_tilde = [&](int r, double h) {
            return root(
                [&](double u) { return Curve<double>(q0, u, pt, monitor).p.at(h, r) - exact.p.at(h, most); },
                p0);
          };
          const auto q_tilde = [&](int r, double h) {
            return root(
                [&](double x) {
                  return Curve<double>(x, p0, pt, monitor).q.at(h, r + 1) - exact.q.at(h, most);
                },
                q0);
          };
          for (int r : {1, 2, 3}) {
            add(
                "p~0 - p0", r, r + 1, [&](double h) { return std::abs(p_tilde(r, h) - p0); }, 0.2);
            add(
                "q~0 - q0", r, r + 2, [&](double h) { return std::abs(q_tilde(r, h) - q0); }, 0.2);
            add(
                "q~1 - q1", r, r + 2,
                [&](double h) {
                  return std::abs(Curve<double>(q0, p_tilde(r, h), pt, monitor).q.at(h, r + 1) -
                                  exact.q.at(h, most));
                },
                0.2);
            add(
                "Taylor curve", r, r + 1,
                [&](double h) {
                  const Curve<double> curve(q0, p_tilde(r, h), pt, monitor);
                  double worst = 0.0;
                  for (int k = 1; k <= 8; ++k)
                    worst = std::max(
                        {worst, std::abs(curve.q.at(0.125 * k * h, r) - exact.q.at(0.125 * k * h, most)),
                         std::abs(curve.p.at(0.125 * k * h, r) - exact.p.at(0.125 * k * h, most))});
                  return worst;
                },
                0.2);
            for (const bool stationary : {false, true}) {
              const Rule rule = gauss(std::min(4, r + 1));
              const auto error = [&, stationary](double h) {
                const Point end = type2_step(z, h, r, rule, stationary, monitor);
                return std::max({std::abs(end[0] - exact.q.at(h, most)),
                                 std::abs(end[1] - exact.t.at(h, most)),
                                 std::abs(end[2] - exact.p.at(h, most))});
              };
              add(stationary ? "stationary step" : "printed step", r, (stationary ? 2 * r + 2 : r + 1) + 1,
                  error, 0.25);
            }
          }
          add(
              "dq1/dp0", 0, singular ? 2 : 1,
              [&](double h) {
                return std::abs(Curve<double>(q0, p0 + 1e-5, pt, monitor).q.at(h, most) -
                                Curve<double>(q0, p0 - 1e-5, pt, monitor).q.at(h, most)) /
                       2e-5;
              },
              0.02);
          add(
              "dp1/dp0 - 1", 0, 1,
              [&](double h) {
                return std::abs((Curve<double>(q0, p0 + 1e-5, pt, monitor).p.at(h, most) -
                                 Curve<double>(q0, p0 - 1e-5, pt, monitor).p.at(h, most)) /
                                    2e-5 -
                                1.0);
              },
              0.02);
          double defect = 0.0;
          for (const bool stationary : {false, true})
            for (int r : {1, 2, 3})
              defect = std::max(defect, extended_defect(z, [&](const Point& w) {
                                  return type2_step(w, 0.05, r, gauss(r + 1), stationary, monitor);
                                }));
          table.row("extended symplecticity", hessian, 0, 0.0, defect, 6);
        }
        frame.write(table);
      });
}
