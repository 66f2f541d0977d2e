#pragma once
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

// Type II HTVI for one degree of freedom and polynomial H and g, written out from its equations without the
// library: a second route to its order, its symplecticity and the lemmas of the paper's appendix.

namespace experiment::statements {

/// A number with its partial derivatives with respect to q_0, u = p~_0 and p^t.
struct Dual {
  double v = 0.0;
  Eigen::Vector3d d = Eigen::Vector3d::Zero();
  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: constants are duals
  Dual(double value, const Eigen::Vector3d& derivatives) : v(value), d(derivatives) {}
};
inline Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
inline Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.d * b.v + a.v * b.d}; }

/// H = p^2/2 + q^2/2 + q^4/4 and the monitor g = 2 + q^2/2 + c p^2.
template <class T>
struct Field {
  double c = -0.25;
  T h(const T& q, const T& p) const { return T(0.5) * p * p + T(0.5) * q * q + T(0.25) * q * q * q * q; }
  T g(const T& q, const T& p) const { return T(2.0) + T(0.5) * q * q + T(c) * p * p; }
  /// g (H + p^t).
  T transformed(const T& q, const T& p, const T& pt) const { return g(q, p) * (h(q, p) + pt); }
  T by_p(const T& q, const T& p, const T& pt) const { return g(q, p) * p + T(2.0 * c) * p * (h(q, p) + pt); }
  T minus_by_q(const T& q, const T& p, const T& pt) const {
    return T(-1.0) * (g(q, p) * (q + q * q * q) + q * (h(q, p) + pt));
  }
};

/// Taylor coefficients that are kept: enough for an exact solution at the steps used.
constexpr int most = 24;

/// A power series in fictive time, truncated.
template <class T>
struct Series {
  std::array<T, most + 1> a{};
  Series() = default;
  Series(double constant) { a[0] = T(constant); }  // NOLINT: constants are series
  T at(double tau, int degree) const {
    T sum = a[static_cast<std::size_t>(degree)];
    for (int k = degree - 1; k >= 0; --k)
      sum = sum * T(tau) + a[static_cast<std::size_t>(k)];
    return sum;
  }
  T slope_at(double tau, int degree) const {
    T sum(0.0);
    for (int k = degree; k >= 1; --k)
      sum = sum * T(tau) + T(static_cast<double>(k)) * a[static_cast<std::size_t>(k)];
    return sum;
  }
};
template <class T>
Series<T> operator+(Series<T> x, const Series<T>& y) {
  for (std::size_t k = 0; k <= most; ++k)
    x.a[k] = x.a[k] + y.a[k];
  return x;
}
template <class T>
Series<T> operator*(const Series<T>& x, const Series<T>& y) {
  Series<T> z;
  for (std::size_t i = 0; i <= most; ++i)
    for (std::size_t j = 0; i + j <= most; ++j)
      z.a[i + j] = z.a[i + j] + x.a[i] * y.a[j];
  return z;
}

/// The solution through (q, p) as a power series, and physical time along it.
template <class T>
struct Curve {
  Series<T> q, p, t;
  Curve(const T& q0, const T& p0, const T& pt, double c, int degree = most) {
    const Field<Series<T>> field{c};
    Series<T> energy;
    energy.a[0] = pt;
    q.a[0] = q0, p.a[0] = p0;
    for (int k = 0; k < degree; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const T by(1.0 / (k + 1));
      const auto dq = field.by_p(q, p, energy), dp = field.minus_by_q(q, p, energy), dt = field.g(q, p);
      q.a[i + 1] = by * dq.a[i], p.a[i + 1] = by * dp.a[i], t.a[i + 1] = by * dt.a[i];
    }
  }
};

/// Nodes and weights of Gauss's rule with two to four nodes on [0, 1].
using Rule = std::vector<std::pair<double, double>>;
inline Rule gauss(int nodes) {
  if (nodes == 2) return {{0.5 - std::sqrt(3.0) / 6.0, 0.5}, {0.5 + std::sqrt(3.0) / 6.0, 0.5}};
  if (nodes == 3)
    return {{0.5 - std::sqrt(15.0) / 10.0, 5.0 / 18.0},
            {0.5, 4.0 / 9.0},
            {0.5 + std::sqrt(15.0) / 10.0, 5.0 / 18.0}};
  const double near = 0.5 * std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(1.2)),
               far = 0.5 * std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(1.2));
  const double big = (18.0 + std::sqrt(30.0)) / 72.0, small = (18.0 - std::sqrt(30.0)) / 72.0;
  return {{0.5 - far, small}, {0.5 - near, big}, {0.5 + near, big}, {0.5 + far, small}};
}

/// q, t, p, p^t.
using Point = std::array<double, 4>;

/// One Type II step on extended phase space with Taylor order r. `stationary`: position to order r + 1 and
/// the velocity of its polynomial at the nodes; else as printed, order r and the velocity of the field.
inline Point type2_step(const Point& z, double h, int r, const Rule& rule, bool stationary, double c) {
  const auto [q0, t0, p0, pt] = z;
  const auto unit = [](int i) { return Eigen::Vector3d::Unit(i); };
  const Dual energy(pt, unit(2));
  const Field<Dual> field{c};
  const int degree = stationary ? r + 1 : r;
  double u = p0;
  Point end{};
  for (int pass = 0; pass < 60; ++pass) {
    const Curve<Dual> x(Dual(q0, unit(0)), Dual(u, unit(1)), energy, c, r + 1);
    const Dual p1 = x.p.at(h, r), q1 = x.q.at(h, r + 1), t1 = x.t.at(h, r + 1);
    Dual k = p1 * q1 + energy * t1;  // H_d^+ less p^t t_0
    for (const auto& [node, weight] : rule) {
      const double tau = node * h;
      const Dual q = x.q.at(tau, degree), p = x.p.at(tau, r);
      const Dual velocity = stationary ? x.q.slope_at(tau, degree) : field.by_p(q, p, energy);
      const Dual clock = stationary ? x.t.slope_at(tau, degree) : field.g(q, p);
      k = k +
          Dual(-h * weight) * (p * velocity + energy * clock + Dual(-1.0) * field.transformed(q, p, energy));
    }
    const double q_end = k.d[1] / p1.d[1];
    const double residual = p0 - (k.d[0] - p1.d[0] * q_end);
    end = {q_end, t0 + k.d[2] - p1.d[2] * q_end, p1.v, pt};
    u += residual;
    if (std::abs(residual) < 1e-16) break;
  }
  return end;
}

}  // namespace experiment::statements
