#pragma once
#include "avi/core/state.hpp"
#include "avi/core/summation.hpp"
#include "avi/integrators/coefficient_lists.hpp"

#include <cmath>

// Reference solutions start from the start as rounded to double. Compared with the unrounded start, every
// method would show the rounding error of the start, 1e-8 after 1000 orbits at e = 0.999.

namespace experiment::work_precision {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;
#endif

/// sin x and 1 - cos x for |x| <= 4, by halving the angle, Taylor series, and doubling it again.
inline void sin_versin(Quad x, Quad& sine, Quad& versine) {
  constexpr int halvings = 7;
  for (int i = 0; i < halvings; ++i)
    x *= 0.5;
  Quad term = x, s = x, v = 0;
  for (int k = 1; k < 12; ++k) {
    term *= x / (2 * k);  // x^(2k) / (2k)!
    v += k % 2 ? term : -term;
    term *= x / (2 * k + 1);
    s += k % 2 ? -term : term;
  }
  for (int i = 0; i < halvings; ++i) {
    s = 2 * s * (1 - v);
    v = 2 * v * (2 - v);  // 1 - cos 2x = 2 sin^2 x = 2 v (2 - v)
  }
  sine = s;
  versine = v;
}

inline Quad square_root(Quad x) {
  Quad root = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 3; ++i)
    root = (root + x / root) / 2;
  return root;
}

/// Position at t >= 0 on the Kepler orbit through `start`. Kepler's equation for the difference D of
/// eccentric anomalies, n t = D - (1 - r_0/a) sin D + (q_0 . p_0 / sqrt a) (1 - cos D), is followed by
/// Gauss's functions f and g.
inline avi::Vector<double, 2> exact_kepler(const avi::State<2>& start, double t) {
  const Quad x = start.q[0], y = start.q[1], px = start.p[0], py = start.p[1];
  const Quad r = square_root(x * x + y * y);
  const Quad a = 1 / (2 / r - (px * px + py * py)), root = square_root(a), n = 1 / (a * root);
  const Quad two_pi =
      2 * (Quad(3.141592653589793116) + Quad(1.2246467991473531772e-16) + Quad(-2.9947698097183396659e-33));
  const double turns = std::round(static_cast<double>(n) * t / (2.0 * M_PI));
  const Quad rest = Quad(t) - Quad(turns) * two_pi / n;
  const Quad mean = n * rest, ec = 1 - r / a, es = (x * px + y * py) / root;
  const double e = std::hypot(static_cast<double>(ec), static_cast<double>(es));
  Quad low = mean - 2 * e - 1e-3, high = mean + 2 * e + 1e-3, d = mean, s = 0, v = 0;
  for (int i = 0; i < 200; ++i) {
    sin_versin(d, s, v);
    const Quad defect = d - ec * s + es * v - mean;
    (defect > 0 ? high : low) = d;
    Quad next = d - defect / (1 - ec * (1 - v) + es * s);
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double change = std::abs(static_cast<double>(next - d));
    d = next;
    if (change <= 1e-32 * (1.0 + std::abs(static_cast<double>(d)))) break;
  }
  sin_versin(d, s, v);
  const Quad f = 1 - a / r * v, g = rest - (d - s) / n;
  return {static_cast<double>(f * x + g * px), static_cast<double>(f * y + g * py)};
}

/// A run in a given number format (extended precision) by the composition of order 10, in physical time or,
/// with log_form, in that of the logarithmic Hamiltonian. Its position can be evaluated at any time.
template <class Problem, class Number = long double, avi::Summation sum = avi::Summation::compensated>
class ExtendedRun {
 public:
  using Real = Number;
  static constexpr int n = Problem::dimension;
  using Vec = avi::Vector<Real, n>;

  ExtendedRun(const Problem& problem, const avi::State<n>& start, bool log_form, Real h)
      : problem_(problem), log_form_(log_form),
        h_(h), now_{start.q.template cast<Real>(), start.p.template cast<Real>(),
                    static_cast<Real>(start.t)} {
    pt_ = -problem_(now_.q, now_.p);
  }

  /// Takes steps as long as they end at or before `horizon`.
  void run_to(double horizon) {
    for (long k = 0; k < 100'000'000; ++k) {
      Point next = now_;
      step(next, h_);
      if (next.t > horizon) return;
      now_ = next;
    }
  }

  /// Position at a time t after the last step; run_to() should have come close to it.
  [[nodiscard]] avi::Vector<double, n> position(double t) const {
    ExtendedRun run = *this;
    run.run_to(t);
    Point& z = run.now_;
    // The last, shorter step is found by Newton's method, with dt/dh taken from the drift.
    Real h = static_cast<Real>(t - z.t) / rate(z);
    for (int i = 0; i < 60; ++i) {
      Point end = z;
      step(end, h);
      const Real change = (static_cast<Real>(t) - end.t) / rate(end);
      h += change;
      if (std::abs(change) <= 1e-18L * h_) break;
    }
    step(z, h);
    return z.q.template cast<double>();
  }

  /// Position and time at the end of the last step.
  [[nodiscard]] avi::Vector<double, n> position() const { return now_.q.template cast<double>(); }
  [[nodiscard]] double time() const { return static_cast<double>(now_.t); }

 private:
  /// A point with its rounding errors; over 1000 orbits they matter even in extended precision.
  struct Point {
    Vec q, p;
    Real t;
    Vec q_low = Vec::Zero(), p_low = Vec::Zero();
    Real t_low = 0;
  };
  [[nodiscard]] Real rate(const Point& z) const {
    if constexpr (requires { problem_.kinetic(z.p); })
      if (log_form_) return 1 / (problem_.kinetic(z.p) + pt_);
    return 1;
  }
  void drift(Point& z, Real h) const {
    const Real dt = h * rate(z);
    if constexpr (requires { problem_.velocity(z.p); })
      avi::add<sum, Vec>(z.q, z.q_low, dt * problem_.velocity(z.p));
    else
      avi::add<sum, Vec>(z.q, z.q_low, dt * z.p);
    avi::add<sum>(z.t, z.t_low, dt);
  }
  void step(Point& z, Real h) const {
    static constexpr auto list = split(avi::compositions::sofroniou_spaletta10);
    for (std::size_t i = 0; i < list.b.size(); ++i) {
      drift(z, list.a[i] * h);
      const Real kick = list.b[i] * h;
      Real factor = -kick;
      if constexpr (requires { problem_.potential(z.q); })
        if (log_form_) factor = kick / problem_.potential(z.q);
      avi::add<sum, Vec>(z.p, z.p_low, factor * problem_.potential_gradient(z.q));
    }
    drift(z, list.a.back() * h);
  }

  const Problem problem_;
  const bool log_form_;
  const Real h_;
  Point now_;
  Real pt_;
};

}  // namespace experiment::work_precision
