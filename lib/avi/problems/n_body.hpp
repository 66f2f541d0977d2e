#pragma once
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <string_view>
#include <utility>

/// @file
/// Newtonian point masses in the plane and in space.

namespace avi {

/// N bodies that attract each other by gravity, in the plane or in space. \f[ H(q, p) = \sum_i
/// \frac{|p_i|^2}{2 m_i} - \sum_{i<j} \frac{m_i m_j}{|q_i - q_j|} \f] with \f$q = (x_1, y_1, x_2, y_2,
/// \ldots)\f$ in \f$R^{dN}\f$, d = `space` = 2 or 3, and unit gravitational constant. For another constant G,
/// use masses \f$G m_i\f$ and momenta \f$G m_i v_i\f$; H is then G times the energy. `bodies`, N, may be
/// avi::dynamic; energies and their gradients then throw std::invalid_argument if q or p does not have dN
/// entries.
template <int bodies, int space = 2>
class NBody {
  static_assert(space == 2 || space == 3, "Bodies move in the plane or in space.");

 public:
  static constexpr int dimension = bodies == dynamic ? dynamic : space * bodies;  ///< dN, or avi::dynamic.
  using Masses = Vector<double, bodies>;                                          ///< One for each body.

  /// The problem for bodies of these masses.
  /// @throws std::invalid_argument for fewer than two bodies, or a mass that is not finite and positive.
  explicit NBody(Masses masses) : masses_(std::move(masses)) {
    require(masses_.size() >= 2, "Number of bodies", masses_.size(), "at least 2");
    for (Eigen::Index i = 0; i < masses_.size(); ++i)
      require_positive("Mass of a body", masses_[i]);
  }

  [[nodiscard]] const Masses& masses() const { return masses_; }  ///< m_i.

  /// Kinetic energy T(p).
  template <class P>
  auto kinetic(const P& p) const {
    require_entries("Number of entries of p", p);
    const auto square = [&](Eigen::Index i) {
      auto sum = p[space * i] * p[space * i];
      for (int k = 1; k < space; ++k)
        sum += p[space * i + k] * p[space * i + k];
      return sum;
    };
    auto sum = square(0) * (0.5 / masses_[0]);
    for (Eigen::Index i = 1; i < masses_.size(); ++i)
      sum += square(i) * (0.5 / masses_[i]);
    return sum;
  }

  /// Velocity dT/dp = (p_i / m_i).
  template <class S>
  Vector<S, dimension> velocity(const Vector<S, dimension>& p) const {
    require_entries("Number of entries of p", p);
    Vector<S, dimension> v = p;
    for (Eigen::Index i = 0; i < p.size(); ++i)
      v[i] = p[i] / masses_[i / space];
    return v;
  }

  /// Potential energy V(q).
  template <class Q>
  auto potential(const Q& q) const {
    using std::sqrt;
    require_entries("Number of entries of q", q);
    auto sum = -(masses_[0] * masses_[1]) / sqrt(distance_squared(q, 0, 1));
    for (Eigen::Index j = 2; j < masses_.size(); ++j)
      for (Eigen::Index i = 0; i < j; ++i)
        sum += -(masses_[i] * masses_[j]) / sqrt(distance_squared(q, i, j));
    return sum;
  }

  /// The Hamiltonian T + V.
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return kinetic(p) + potential(q);
  }

  /// dV/dq, dN entries.
  template <class S>
  Vector<S, dimension> potential_gradient(const Vector<S, dimension>& q) const {
    using std::sqrt;
    require_entries("Number of entries of q", q);
    Vector<S, dimension> gradient = q - q;
    for (Eigen::Index j = 1; j < masses_.size(); ++j)
      for (Eigen::Index i = 0; i < j; ++i) {
        S x[space];
        for (int k = 0; k < space; ++k)
          x[k] = q[space * i + k] - q[space * j + k];
        S square = x[0] * x[0] + x[1] * x[1];
        if constexpr (space == 3) square += x[2] * x[2];
        const S u = (masses_[i] * masses_[j]) / (square * sqrt(square));
        for (int k = 0; k < space; ++k) {
          gradient[space * i + k] += x[k] * u;
          gradient[space * j + k] -= x[k] * u;
        }
      }
    return gradient;
  }

  /// dH/dq, dN entries, supplied for speed.
  template <class S>
  Vector<S, dimension> d_dq(const Vector<S, dimension>& q, const Vector<S, dimension>&) const {
    return potential_gradient(q);
  }
  /// dH/dp, dN entries, supplied for speed.
  template <class S>
  Vector<S, dimension> d_dp(const Vector<S, dimension>&, const Vector<S, dimension>& p) const {
    return velocity(p);
  }

  /// |q_i - q_j|^2.
  template <class Q>
  static auto distance_squared(const Q& q, Eigen::Index i, Eigen::Index j) {
    const auto square = [&](int k) {
      const auto x = q[space * i + k] - q[space * j + k];
      return x * x;
    };
    auto sum = square(0) + square(1);
    if constexpr (space == 3) sum += square(2);
    return sum;
  }

  /// Total momentum, d entries, conserved.
  static Vector<double, space> momentum(const State<dimension>& z) {
    Vector<double, space> sum = Vector<double, space>::Zero();
    for (Eigen::Index i = 0; i < z.p.size(); ++i)
      sum[i % space] += z.p[i];
    return sum;
  }

  /// Angular momentum about the axis perpendicular to coordinates k and l: \f$\sum_i x_{i,k} p_{i,l} -
  /// x_{i,l} p_{i,k}\f$, conserved. In the plane it is the only one.
  /// @throws std::invalid_argument for a coordinate that a body does not have, and for q and p of different
  /// size.
  static double angular_momentum(const State<dimension>& z, int k = 0, int l = 1) {
    for (const int coordinate : {k, l})
      require(coordinate >= 0 && coordinate < space, "Coordinate of a body", coordinate,
              "at least 0 and below ", space);
    require(z.p.size() == z.q.size(), "Number of entries of p", z.p.size(), "that of q, ", z.q.size());
    double sum = 0.0;
    for (Eigen::Index i = 0; i + space <= z.q.size(); i += space)
      sum += z.q[i + k] * z.p[i + l] - z.q[i + l] * z.p[i + k];
    return sum;
  }

 private:
  template <class X>
  void require_entries(std::string_view what, const X& x) const {
    if constexpr (bodies == dynamic)
      require(x.size() == space * masses_.size(), what, x.size(), "", space, " for each of ", masses_.size(),
              " bodies");
  }

  Masses masses_;
};

/// The figure-eight orbit: three unit masses that follow each other along one curve.
///
/// Existence: Chenciner and Montgomery (A remarkable periodic solution of the three-body problem in the case
/// of equal masses, 2000). The digits of the start and of the period were computed by Carles Simo and are
/// printed there.
struct FigureEight {
  static constexpr double period = 6.32591398;  ///< To nine digits, as printed.

  /// The three-body problem of this orbit.
  static NBody<3> problem() { return NBody<3>(NBody<3>::Masses::Ones()); }

  /// Start of the orbit: two bodies at (+-0.97000436, -+0.24308753), the third between them at the origin.
  static State<6> start() {
    State<6> z;
    const double vx = 0.93240737, vy = 0.86473146;
    z.q << 0.97000436, -0.24308753, -0.97000436, 0.24308753, 0.0, 0.0;
    z.p << 0.5 * vx, 0.5 * vy, 0.5 * vx, 0.5 * vy, -vx, -vy;
    return z;
  }
};

}  // namespace avi
