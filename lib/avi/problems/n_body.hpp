#pragma once
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <utility>

/// @file
/// Newtonian point masses in the plane.

namespace avi {

/// N bodies that attract each other. \f[ H(q, p) = \sum_i \frac{|p_i|^2}{2 m_i} - \sum_{i<j} \frac{m_i
/// m_j}{|q_i - q_j|} \f] with \f$q = (x_1, y_1, x_2, y_2, \ldots)\f$ in \f$R^{2N}\f$ and unit gravitational
/// constant. `bodies` N may be avi::dynamic: one code path for both.
template <int bodies>
class NBody {
 public:
  static constexpr int dimension = bodies == dynamic ? dynamic : 2 * bodies;  ///< 2N, or avi::dynamic.
  using Masses = Vector<double, bodies>;                                      ///< One for each body.

  /// Bodies of these masses.
  /// @throws std::invalid_argument for fewer than two bodies or a mass that is not finite and positive.
  explicit NBody(Masses masses) : masses_(std::move(masses)) {
    require(masses_.size() >= 2, "Number of bodies", masses_.size(), "at least 2");
    for (Eigen::Index i = 0; i < masses_.size(); ++i)
      require_positive("Mass of a body", masses_[i]);
  }

  [[nodiscard]] const Masses& masses() const { return masses_; }  ///< m_i.

  /// Kinetic energy.
  template <class P>
  auto kinetic(const P& p) const {
    auto sum = p[0] * p[0] * (0.5 / masses_[0]) + p[1] * p[1] * (0.5 / masses_[0]);
    for (Eigen::Index i = 1; i < masses_.size(); ++i)
      sum += (p[2 * i] * p[2 * i] + p[2 * i + 1] * p[2 * i + 1]) * (0.5 / masses_[i]);
    return sum;
  }

  /// Velocity dT/dp = (p_i / m_i).
  template <class S>
  Vector<S, dimension> velocity(const Vector<S, dimension>& p) const {
    Vector<S, dimension> v = p;
    for (Eigen::Index i = 0; i < p.size(); ++i)
      v[i] = p[i] / masses_[i / 2];
    return v;
  }

  /// Potential energy.
  template <class Q>
  auto potential(const Q& q) const {
    using std::sqrt;
    auto sum = -(masses_[0] * masses_[1]) / sqrt(distance_squared(q, 0, 1));
    for (Eigen::Index j = 2; j < masses_.size(); ++j)
      for (Eigen::Index i = 0; i < j; ++i)
        sum += -(masses_[i] * masses_[j]) / sqrt(distance_squared(q, i, j));
    return sum;
  }

  /// The Hamiltonian.
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return kinetic(p) + potential(q);
  }

  /// dV/dq, 2N entries.
  template <class S>
  Vector<S, dimension> potential_gradient(const Vector<S, dimension>& q) const {
    using std::sqrt;
    Vector<S, dimension> gradient = q - q;
    for (Eigen::Index j = 1; j < masses_.size(); ++j)
      for (Eigen::Index i = 0; i < j; ++i) {
        const S x = q[2 * i] - q[2 * j], y = q[2 * i + 1] - q[2 * j + 1];
        const S square = x * x + y * y;
        const S u = (masses_[i] * masses_[j]) / (square * sqrt(square));
        gradient[2 * i] += x * u;
        gradient[2 * i + 1] += y * u;
        gradient[2 * j] -= x * u;
        gradient[2 * j + 1] -= y * u;
      }
    return gradient;
  }

  /// dH/dq, 2N entries, supplied for speed.
  template <class S>
  Vector<S, dimension> d_dq(const Vector<S, dimension>& q, const Vector<S, dimension>&) const {
    return potential_gradient(q);
  }
  /// dH/dp, 2N entries, supplied for speed.
  template <class S>
  Vector<S, dimension> d_dp(const Vector<S, dimension>&, const Vector<S, dimension>& p) const {
    return velocity(p);
  }

  /// |q_i - q_j|^2.
  template <class Q>
  static auto distance_squared(const Q& q, Eigen::Index i, Eigen::Index j) {
    const auto x = q[2 * i] - q[2 * j];
    const auto y = q[2 * i + 1] - q[2 * j + 1];
    return x * x + y * y;
  }

  /// Angular momentum sum_i x_i p_{y,i} - y_i p_{x,i}, conserved.
  static double angular_momentum(const State<dimension>& z) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i + 1 < z.q.size(); i += 2)
      sum += z.q[i] * z.p[i + 1] - z.q[i + 1] * z.p[i];
    return sum;
  }

 private:
  Masses masses_;
};

/// Three unit masses chasing each other along one figure-eight curve.
///
/// Existence: Chenciner and Montgomery (A remarkable periodic solution of the three-body problem in the case
/// of equal masses, 2000); digits of the start and of the period computed by Carles Simo, printed there.
struct FigureEight {
  static constexpr double period = 6.32591398;  ///< To nine digits, as printed.

  /// The problem; `bodies` is 3 or avi::dynamic.
  template <int bodies = 3>
  static NBody<bodies> problem() {
    static_assert(bodies == 3 || bodies == dynamic, "The figure-eight orbit has three bodies.");
    return NBody<bodies>(NBody<bodies>::Masses::Ones(3));
  }

  /// Two bodies at (+-0.97000436, -+0.24308753), the third between them at the origin.
  template <int n = 6>
  static State<n> start() {
    State<n> z{.q = Vector<double, n>(6), .p = Vector<double, n>(6)};
    const double vx = 0.93240737, vy = 0.86473146;
    z.q << 0.97000436, -0.24308753, -0.97000436, 0.24308753, 0.0, 0.0;
    z.p << 0.5 * vx, 0.5 * vy, 0.5 * vx, 0.5 * vy, -vx, -vy;
    return z;
  }
};

}  // namespace avi
