#pragma once
#include "avi/core/integrate.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// How far one step of a method is from being symplectic.

namespace avi {

/// Range of the spacings tried by difference_jacobian(): powers of two, in the units of the point.
struct Spacings {
  double largest = 0.0625;         ///< Tried first.
  double smallest = 1.0 / 8192.0;  ///< Tried last; positive.
};

/// Jacobian of `map` (VectorX -> same length) at z by central differences of order 2m = 16,
/// \f$f'(x) \approx \sum_{k=1}^m w_k\, (f(x + k s) - f(x - k s)) / (2 k s)\f$ with
/// \f$w_k = 2\,(-1)^{k+1}\, (m!)^2 / ((m - k)!\, (m + k)!)\f$ (Fornberg 1988).
///
/// For each column, the spacing is used at which the formulas of orders 14 and 16 agree best. There
/// truncation and round-off balance, at a relative error of about 1e-14 for a smooth map. The difference of
/// the two formulas is taken to be at least the rounding error of the map. Otherwise a spacing so small that
/// the map does not change at all would win, because both formulas then agree on a meaningless slope.
/// @throws std::invalid_argument for a map whose value has another size than z, and for spacings out of
/// range.
template <class Map>
Matrix<double, dynamic> difference_jacobian(Map&& map, const VectorX& z, Spacings spacings = {}) {
  require_positive("Smallest spacing", spacings.smallest);
  require(spacings.largest >= spacings.smallest && std::isfinite(spacings.largest), "Largest spacing",
          spacings.largest, "finite and at least the smallest");
  constexpr int pairs = 8;
  const auto weight = [](int m, int k) {
    double w = k % 2 == 1 ? 2.0 : -2.0;
    for (int i = 1; i <= k; ++i)
      w *= static_cast<double>(m - i + 1) / (m + i);
    return w;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Matrix<double, dynamic> jacobian = Matrix<double, dynamic>::Constant(z.size(), z.size(), nan);
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    double best = std::numeric_limits<double>::infinity();
    for (double s = spacings.largest; s >= spacings.smallest; s *= 0.5) {
      VectorX fine = VectorX::Zero(z.size()), coarse = fine;
      double size = 0.0;
      for (int k = 1; k <= pairs; ++k) {
        VectorX ahead = z, behind = z;
        ahead[j] += k * s;
        behind[j] -= k * s;
        const VectorX front = map(ahead), back = map(behind);
        for (const VectorX* value : {&front, &back})
          require(value->size() == z.size(), "Size of the value of the map", value->size(),
                  "that of the point, ", z.size());
        size = std::max(size, largest_entry(front));
        for (Eigen::Index i = 0; i < z.size(); ++i) {
          // Divided by the actual distance of the two points, which rounding has changed.
          const double slope = (front[i] - back[i]) / (ahead[j] - behind[j]);
          fine[i] += weight(pairs, k) * slope;
          coarse[i] += weight(pairs - 1, k) * slope;  // zero for the last pair
        }
      }
      // Rounding of all values by eps / 2 makes the two formulas differ by about eps / 64 of the values,
      // divided by s.
      const double rounding = std::numeric_limits<double>::epsilon() / 64.0 * size / s;
      const double doubt = std::max(largest_entry(fine - coarse), rounding);
      if (!(doubt < best)) continue;
      best = doubt;
      for (Eigen::Index i = 0; i < z.size(); ++i)
        jacobian(i, j) = fine[i];
    }
  }
  return jacobian;
}

namespace detail {
/// The defect \f$\|J^T \Omega J - \Omega\|_F\f$ of a Jacobian matrix J.
inline double symplecticity_defect_of(const Matrix<double, dynamic>& jacobian) {
  const Eigen::Index m = jacobian.cols() / 2;
  // The matrix is antisymmetric, so half of it suffices. Eigen's matrix products take a second to compile.
  double squares = 0.0;
  for (Eigen::Index b = 0; b < 2 * m; ++b)
    for (Eigen::Index a = 0; a < b; ++a) {
      double defect = b - a == m ? -1.0 : 0.0;
      for (Eigen::Index i = 0; i < m; ++i)
        defect += jacobian(i, a) * jacobian(m + i, b) - jacobian(m + i, a) * jacobian(i, b);
      squares += 2.0 * defect * defect;
    }
  return std::sqrt(squares);
}
}  // namespace detail

/// The defect \f$\|J^T \Omega J - \Omega\|_F\f$ of a map of phase space \f$R^{2m} \to R^{2m}\f$ with z = (q,
/// p), \f$\Omega = \left(\begin{smallmatrix} 0 & I \\ -I & 0 \end{smallmatrix}\right)\f$ and J by
/// difference_jacobian(). It is zero for a symplectic map, and NaN if the map fails. The map may also act on
/// an extended phase space, (q, t, p, p^t).
/// @throws std::invalid_argument if z has an odd number of entries, or the value of the map another size.
template <class Map>
double symplecticity_defect(Map&& map, const VectorX& z, Spacings spacings = {}) {
  require(z.size() > 0 && z.size() % 2 == 0, "Dimension of phase space", z.size(), "even and positive");
  return detail::symplecticity_defect_of(difference_jacobian(map, z, spacings));
}

/// The defect of one step h of `method` at z, as a map of (q, p) at fixed start time. It is measured in units
/// of the point: powers of two near the largest entry of q, and of p, at either end of the step. Up to a
/// factor these units are symplectic. The rounding error of a heavy body adds about 1e-16 c for a coupled
/// body c times lighter. Each evaluation uses a fresh copy of the method, so that nothing it remembers
/// between steps (a kept gradient, the state of a controller) affects the next evaluation.
/// @throws std::invalid_argument if q and p, of a dimension given at run time, are empty or differ in size.
template <int n, Method<State<n>> M>
double symplecticity_defect(const M& method, const State<n>& z, double h) {
  require_dimension(z);
  const Eigen::Index m = z.q.size();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  State<n> end = z;
  if (M fresh = method; fresh.step(end, h).outcome != Outcome::ok) return nan;
  const auto unit = [](double one, double other) {
    const double size = std::max(one, other);
    return size > 0.0 && std::isfinite(size) ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
  };
  const double of_q = unit(largest_entry(z.q), largest_entry(end.q)),
               of_p = unit(largest_entry(z.p), largest_entry(end.p));
  VectorX start(2 * m), units(2 * m);
  start << z.q, z.p;
  units << VectorX::Constant(m, of_q), VectorX::Constant(m, of_p);
  const auto map = [&](const VectorX& point) {
    M fresh = method;
    State<n> moved = z;
    for (Eigen::Index i = 0; i < m; ++i) {
      moved.q[i] = point[i] * units[i];
      moved.p[i] = point[m + i] * units[m + i];
    }
    VectorX image = VectorX::Constant(2 * m, nan);
    if (fresh.step(moved, h).outcome == Outcome::ok)
      image << moved.q.cwiseQuotient(units.head(m)), moved.p.cwiseQuotient(units.tail(m));
    return image;
  };
  // Far from the origin the map may vary over a distance of 1 in the original units, so smaller spacings are
  // allowed. Near the rounding error of the point, differences would be meaningless.
  Spacings spacings;
  spacings.smallest = std::max(spacings.smallest / std::max({1.0, of_q, of_p}), 0x1p-44);
  Matrix<double, dynamic> jacobian = difference_jacobian(map, start.cwiseQuotient(units), spacings);
  // An entry much smaller than the others of q or p, such as the momentum of a light body, moves the image a
  // long way within one spacing. It gets a finer unit for its differences.
  VectorX finer = VectorX::Ones(2 * m);
  for (Eigen::Index j = 0; j < 2 * m; ++j)
    if (const double steepest = largest_entry(jacobian.col(j));
        std::isfinite(steepest) && steepest * spacings.largest > 1.0)
      finer[j] = std::ldexp(1.0, std::ilogb(steepest));
  if (largest_entry(finer) > 1.0) {
    units = units.cwiseQuotient(finer);
    jacobian = difference_jacobian(map, start.cwiseQuotient(units), spacings);
    for (Eigen::Index j = 0; j < 2 * m; ++j)
      for (Eigen::Index i = 0; i < 2 * m; ++i)
        jacobian(i, j) *= finer[j] / finer[i];
  }
  return detail::symplecticity_defect_of(jacobian);
}

}  // namespace avi
