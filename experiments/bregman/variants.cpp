#include "avi/integrators/runge_kutta.hpp"
#include "beyond/counts/sustained.hpp"
#include "bregman/printed/cloning_printed.hpp"
#include "common/frame.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "optimisers/table6_search/modes.hpp"

#include <algorithm>
#include <cmath>

// Variants that the paper mentions without numbers: the limit equation of Nesterov's method, Type III of
// order zero (a proximal step), Tao's binding of the two copies, and a mirror map on the simplex. Beside them
// what they are to be compared with: proximal points without momentum, and the copy of Strang's cloning that
// is not read.

namespace {

using namespace experiment;
using avi::VectorX;

/// The quartic in the eigenvectors of Sigma that starts with equal entries excite, where its proximal map is
/// one scalar equation.
class DiagonalQuartic {
 public:
  /// A vector in the coordinates of the eigenvectors.
  [[nodiscard]] VectorX turned(double every_entry) const { return every_entry * ones_; }

  double operator()(const VectorX& u, VectorX& gradient) const {
    const double form = form_of(u);
    gradient = 4.0 * form * (sigma_.array() * u.array()).matrix();
    return form * form;
  }
  /// prox of lambda f: y + lambda grad f(y) = u, that is y_i = u_i / (1 + 4 lambda k sigma_i), k = y^T Sigma
  /// y.
  [[nodiscard]] VectorX prox(double lambda, const VectorX& u) const {
    const auto point = [&](double k) -> VectorX {
      return u.array() / (1.0 + 4.0 * lambda * k * sigma_.array());
    };
    double low = 0.0, high = form_of(u);  // form_of(point(k)) - k falls from positive to negative
    for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
      const double middle = 0.5 * (low + high);
      (form_of(point(middle)) > middle ? low : high) = middle;
    }
    return point(0.5 * (low + high));
  }

 private:
  [[nodiscard]] double form_of(const VectorX& y) const { return (sigma_.array() * y.array().square()).sum(); }

  table6_search::Spectrum spectrum_ = table6_search::spectrum();
  VectorX sigma_ = Eigen::Map<VectorX>(spectrum_.lambda.data(), table6_search::modes);
  VectorX ones_ = Eigen::Map<VectorX>(spectrum_.ones.data(), table6_search::modes);
};

/// A run of iterates, followed until the stopping test has held for good, f is no number, or a cap is
/// reached.
struct Followed : Sustained {
  bool diverged = false;
};
Followed followed(const auto& f, VectorX q, long cap, auto step) {
  Followed seen;
  avi::Iterate at;
  for (long k = 1; k <= cap; ++k) {
    step(q);
    at.value = f(q, at.gradient);
    seen.diverged = !std::isfinite(at.value) || at.value > 1e30;
    if (seen.diverged) break;
    if (!seen(at, k, k)) break;
  }
  return seen;
}

/// Adaptive (4, 1) at the published start, by Type II or Type III.
Followed proximal(const DiagonalQuartic& f, bool third, double h, long cap) {
  constexpr double p = 4.0, s = 0.25, big_p = 16.0, c = 0.0625;
  VectorX r = f.turned(1.0), gradient;
  double t = 1.0;
  return followed(f, f.turned(4.0), cap, [&](VectorX& q) {
    const double eta = big_p * h * std::pow(t, -s), force = eta * c * std::pow(t, p);
    f(third ? f.prox(eta * force, q) : q, gradient);
    r -= force * gradient;
    q += eta * r;
    const double next = t + h / s * std::pow(t, 1.0 - s);
    r *= std::pow(t / next, p);
    t = next;
  });
}

/// Proximal points x <- prox of lambda f, lambda that of `proximal` at the same iteration: Type III without
/// its momentum.
Followed proximal_points(const DiagonalQuartic& f, double h, long cap) {
  constexpr double p = 4.0, s = 0.25, big_p = 16.0, c = 0.0625;
  double t = 1.0;
  return followed(f, f.turned(4.0), cap, [&](VectorX& q) {
    const double eta = big_p * h * std::pow(t, -s);
    q = f.prox(eta * eta * c * std::pow(t, p), q);
    t += h / s * std::pow(t, 1.0 - s);
  });
}

/// The other copy of Strang's cloning at the published start: the flow of H-bar_2 kicks it, that of H-bar_1
/// moves it, so its step is kick, drift, kick, and the gradient at its end would serve the stopping test and
/// the next step.
Followed kicked_first(const BregmanFamily& family, double h, long cap) {
  const CorrelatedQuartic f;
  const MergedStages stages = merged_stages(CloneComposition::strang);
  avi::ExtendedPoint z{.q = f.start(), .t = 1.0, .r = VectorX::Constant(50, 1.0)}, clone = z;
  return followed(f, clone.q, cap, [&](VectorX& q) {
    cloning_printed_step(family, f, h, stages, z, clone);
    q = clone.q;
  });
}

/// Direct p = 4 by two copies that omega binds (Strang); gradient of the read copy is the stopping test's,
/// too.
Followed bound(const DiagonalQuartic& f, double omega, double h, long cap) {
  constexpr double p = 4.0, c = 0.0625;
  VectorX x = f.turned(4.0), r = f.turned(1.0), y = r, g;  // (q, r) and (x, y)
  double t = 1.0;
  return followed(f, x, cap, [&](VectorX& q) {
    const double middle = t + 0.5 * h, a = p * std::pow(middle, -p - 1.0),
                 b = c * p * std::pow(middle, 2.0 * p - 1.0);
    const auto first = [&](double k) { f(q, g), r -= k * b * g, x += k * a * y; };
    const auto second = [&](double k) { f(x, g), y -= k * b * g, q += k * a * r; };
    first(0.5 * h), second(0.5 * h);
    const double cosine = std::cos(2.0 * omega * h), sine = std::sin(2.0 * omega * h);
    const VectorX dq = q - x, dr = r - y, mean_q = q + x, mean_r = r + y;
    const VectorX turned_q = cosine * dq + sine * dr, turned_r = cosine * dr - sine * dq;
    q = 0.5 * (mean_q + turned_q), x = 0.5 * (mean_q - turned_q);
    r = 0.5 * (mean_r + turned_r), y = 0.5 * (mean_r - turned_r);
    second(0.5 * h), first(0.5 * h);
    t += h;
  });
}

/// Largest distance over t <= 4 of Nesterov's iterates from x'' + (3/t) x' + grad f = 0 at t = k sqrt(h).
double distance_to_limit(double h) {
  const CorrelatedQuartic f(3, 0.5);
  const VectorX start = VectorX::Constant(3, 1.6);
  const double root = std::sqrt(h);
  VectorX x = start, y = start, before = start, g(3), z(7);  // z = (x, x', t) of the equation
  z << start, VectorX::Zero(4);
  avi::RungeKuttaStages<avi::ClassicalRungeKutta> stages(7);
  const auto field = [&](const VectorX& at, VectorX& rate) {
    const VectorX speed = at.segment(3, 3);
    const double t = at[6];
    f(at.head(3), g);
    rate << speed, t > 0.0 ? VectorX(-3.0 / t * speed - g) : VectorX(-0.25 * g), 1.0;  // both terms at t = 0
  };
  double worst = 0.0;
  for (int k = 1; k * root <= 4.0; ++k) {
    f(y, g);
    before = x;
    x = y - h * g;
    y = x + (k - 1.0) / (k + 2.0) * (x - before);
    for (int part = 0; part < 8; ++part) {
      field(z, stages.k[0]);
      stages.advance(field, z, root / 8.0);
      z.swap(stages.end);
    }
    worst = std::max(worst, (x - z.head(3)).norm());
  }
  return worst;
}

/// Largest f C t^p over the Lyapunov function at the start, f = |A x - b|^2 / 2 with least value 0 on the
/// simplex, by w <- w - h C p t^(p-1) grad f(x), x <- x + (p h / t) (softmax(w) - x); NaN if an iterate
/// leaves the simplex.
double mirror(double h) {
  constexpr Eigen::Index n = 10;
  constexpr double p = 2.0, c = 0.25, t0 = 1.0;
  Eigen::MatrixXd a(n, n);
  VectorX solution(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    solution[i] = 1.0 + static_cast<double>(i);
    for (Eigen::Index j = 0; j < n; ++j)
      a(i, j) = std::sin(1.7 * static_cast<double>(i * n + j) + 0.3);
  }
  solution /= solution.sum();
  const auto softmax = [](const VectorX& w) -> VectorX {
    const double most = w.maxCoeff();
    const VectorX e = w.unaryExpr([most](double v) { return std::exp(v - most); });
    return e / e.sum();
  };
  VectorX w = VectorX::Zero(n), x = softmax(w);
  const auto value = [&] { return 0.5 * (a * (x - solution)).squaredNorm(); };
  double energy = c * std::pow(t0, p) * value();
  for (Eigen::Index i = 0; i < n; ++i)
    energy += solution[i] * std::log(solution[i] / x[i]);
  double worst = 0.0;
  for (double t = t0; t < 200.0; t += h) {
    w -= h * c * p * std::pow(t, p - 1.0) * (a.transpose() * (a * (x - solution)));
    x += p * h / t * (softmax(w) - x);
    if (x.minCoeff() < 0.0 || std::abs(x.sum() - 1.0) > 1e-12) return std::nan("");
    worst = std::max(worst, value() * c * std::pow(t + h, p) / energy);
  }
  return worst;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"variant", "parameter", "setting", "first_passage", "sustained",
                              "gradients_per_step", "value", "end"});
  table.note("type_2, type_3",
             "Adaptive (4, 1), h in units of the published 2.4e-4; a proximal step counts as one gradient");
  table.note("proximal_points", "Type III's proximal steps without its momentum");
  table.note("kick_first",
             "Strang's cloning with p = 4, p_ring = 1, read from the copy that is kicked first");
  table.note("binding", "Direct p = 4, h = 9.7e-4, two copies bound by omega; t of both frozen at mid-step");
  table.note("nag_limit", "largest distance to the limit equation up to t = 4");
  table.note("mirror", "largest ratio of f - f* to its bound on the simplex, entropy");
  const DiagonalQuartic f;
  const auto row = [&](const char* variant, const char* parameter, double setting, const Followed& s,
                       double gradients_per_step) {
    table.row(variant, parameter, setting, s.first > 0 ? s.first : unknown,
              s.confirmed ? s.sustained() : unknown, gradients_per_step, unknown,
              s.diverged    ? "diverges"
              : s.confirmed ? "converges"
                            : "at the cap");
  };
  const long cap = frame.quick ? 160'000 : 1'600'000;
  table.note("cap", cap);
  for (double factor : {1.0, 10.0, 100.0, 1000.0}) {
    row("type_2", "h", factor, proximal(f, false, factor * 2.4e-4, cap), 1.0);
    row("type_3", "h", factor, proximal(f, true, factor * 2.4e-4, cap), 1.0);
  }
  for (double factor : {1.0, 10.0, 100.0, 1000.0})
    row("proximal_points", "h", factor, proximal_points(f, factor * 2.4e-4, cap), 1.0);
  row("kick_first", "direct", 9.7e-4, kicked_first(BregmanFamily::direct(4.0), 9.7e-4, cap), 1.0);
  row("kick_first", "adaptive", 2.4e-4, kicked_first(BregmanFamily::adaptive(4.0, 1.0), 2.4e-4, cap), 1.0);
  for (double omega : {0.0, 1e-4, 1e-2, 1.0, 100.0})
    row("binding", "omega", omega, bound(f, omega, 9.7e-4, cap), omega == 0.0 ? 1.0 : 3.0);
  for (double h : {1e-2, 2.5e-3, 6.25e-4, 1.5625e-4})
    table.row("nag_limit", "h", h, unknown, unknown, unknown, distance_to_limit(h), "nan");
  for (double h : {0.1, 0.01, 0.001})
    table.row("mirror", "h", h, unknown, unknown, unknown, mirror(h), "nan");
}
