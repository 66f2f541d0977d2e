#include "beyond/speed/automatic_monitors/curvature.hpp"

#include "avi/autodiff/formula.hpp"
#include "avi/autodiff/partials.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace curvature_test {

using Block = Eigen::Matrix2d;

/// A Hamiltonian of every kind of term, z = (q, p): constant and variable metric, mixed, potential.
template <int k, class Z>
auto term(const Z& z) {
  using std::exp, std::sin;
  if constexpr (k == 0) return 0.5 * z[2] * z[2];
  if constexpr (k == 1) return z[3] * z[3];
  if constexpr (k == 2) return 0.3 * z[2] * z[3];
  if constexpr (k == 3) return 0.1 * z[0] * z[0] * z[3] * z[3];
  if constexpr (k == 4) return 0.7 * z[0] * z[3] * z[1];
  if constexpr (k == 5) return exp(z[0] * z[1]) / 2.0;
  if constexpr (k == 6) return -0.4 * z[0] * z[0] * z[0];
  if constexpr (k == 7) return 0.2 * sin(z[1]) * z[2];
}
constexpr auto terms = std::make_integer_sequence<int, 8>{};

/// H(q, p), in which one sum is scaled and one term is subtracted.
struct Everything {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const avi::Vector<typename Q::Scalar, 4> z{q[0], q[1], p[0], p[1]};
    return 2.0 * (0.5 * term<0>(z) + (term<1>(z) + term<2>(z)) / 2.0) + term<3>(z) + term<4>(z) + term<5>(z) -
           (-1.0 * term<6>(z)) + term<7>(z) - 0.5 * term<0>(z) + 0.5 * term<0>(z);
  }
};

/// Second derivatives of one term, by nested partials.
template <int k>
Eigen::Matrix4d hessian(const Eigen::Vector4d& at) {
  using Inner = avi::Partials<double, 4>;
  using Outer = avi::Partials<Inner, 4>;
  avi::Vector<Outer, 4> z;
  for (int i = 0; i < 4; ++i)
    z[i] = Outer::variable(Inner::variable(at[i], i), i);
  const Outer value = term<k>(z);
  Eigen::Matrix4d h;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      h(i, j) = value.partial(i).partial(j);
  return h;
}

/// |A|^2 of the blocks of one term's Hessian, in the metric K: of (q, q) and of (q, p).
struct Squares {
  double qq = 0.0, qp = 0.0;
  void add(const Eigen::Matrix4d& h, const Block& metric) {
    const Block a = h.topLeftCorner<2, 2>(), b = h.topRightCorner<2, 2>();
    qq += (a * metric * a * metric).trace();
    qp += (b * metric.inverse() * b.transpose() * metric).trace();
  }
};

TEST(Curvature, IsWhatItsDefinitionSaysTermByTerm) {
  const avi::State<2> start{.q = {0.4, -0.3}, .p = {0.2, 0.5}};
  experiment::Curvature curvature({Everything(), start});
  const avi::Formula n0(curvature.graph, curvature.squared_frequency_squared());
  constexpr double frequency = 1.7;
  const avi::Formula speed(curvature.graph, curvature.squared_speed(frequency));

  const auto total = [](const Eigen::Vector4d& z) {
    return [&]<int... k>(std::integer_sequence<int, k...>)->Eigen::Matrix4d { return (hessian<k>(z) + ...); }
    (terms);
  };
  const Eigen::Vector4d at_start(0.4, -0.3, 0.2, 0.5);
  const Block metric = total(at_start).bottomRightCorner<2, 2>(), inverse = metric.inverse();
  for (const Eigen::Vector4d& z : {at_start, Eigen::Vector4d(1.1, 0.6, -0.7, 0.9)}) {
    Squares squares;
    [&]<int... k>(std::integer_sequence<int, k...>) { (squares.add(hessian<k>(z), metric), ...); }
    (terms);
    const Block pp = total(z).bottomRightCorner<2, 2>();
    const double spread = (pp * inverse * pp * inverse).trace() / 2.0;
    const avi::Vector<double, 2> q = z.head<2>(), p = z.tail<2>();
    EXPECT_NEAR(n0(q, p) / (spread * squares.qq + squares.qp * squares.qp), 1.0, 1e-14);

    using S = avi::Partials<double, 4>;
    avi::Vector<S, 2> x, y;
    for (int i = 0; i < 2; ++i) {
      x[i] = S::variable(q[i], i);
      y[i] = S::variable(p[i], 2 + i);
    }
    const S energy = Everything()(x, y);
    const Eigen::Vector2d force(energy.partial(0), energy.partial(1)),
        velocity(energy.partial(2), energy.partial(3));
    const double positions = velocity.dot(inverse * velocity), momenta = force.dot(metric * force);
    EXPECT_NEAR(speed(q, p) / (positions + momenta / (frequency * frequency)), 1.0, 1e-14);
    const auto [fast, pushed] =
        curvature.squared_speeds(Eigen::Vector4d(velocity[0], velocity[1], -force[0], -force[1]));
    EXPECT_NEAR(fast / positions, 1.0, 1e-14);
    EXPECT_NEAR(pushed / momenta, 1.0, 1e-14);
  }
}

TEST(Curvature, HasNoMetricWhereHppIsIndefinite) {
  const auto saddle = [](const auto& q, const auto& p) { return p[0] * p[0] - p[1] * p[1] + q[0] * q[1]; };
  const auto leaning = [](const auto& q, const auto& p) {
    return p[0] * p[0] + p[1] * p[1] + 2.5 * p[0] * p[1] + q[0] * q[1];
  };
  const auto upright = [](const auto& q, const auto& p) {
    return p[0] * p[0] + p[1] * p[1] + 1.5 * p[0] * p[1] + q[0] * q[1];
  };
  const avi::State<2> z{.q = {1.0, 2.0}, .p = {0.5, 0.5}};
  EXPECT_THROW(experiment::Curvature({saddle, z}), std::invalid_argument);
  EXPECT_THROW(experiment::Curvature({leaning, z}), std::invalid_argument);
  EXPECT_NO_THROW(experiment::Curvature({upright, z}));
}

}  // namespace curvature_test
