#include "src/minimise/secant_pairs.hpp"

#include <Eigen/LU>

#include <gtest/gtest.h>

using avi::VectorX;

namespace secant_pairs_test {

/// Stores a pair, with the products of a gradient.
void add_pair(avi::SecantPairs& pairs, const VectorX& s, const VectorX& y, const VectorX& g,
              VectorX& with_pairs) {
  VectorX change(pairs.products());
  Eigen::Map<VectorX>(pairs.next_s(), s.size()) = s;
  Eigen::Map<VectorX>(pairs.next_y(), s.size()) = y;
  pairs.multiply(y.data(), change.data());
  pairs.multiply(g.data(), with_pairs.data());
  pairs.commit(g.data(), s.dot(y), y.squaredNorm(), change.data(), with_pairs.data(), s.dot(g), y.dot(g));
}

/// That of a gradient, from the products that it has with the pairs.
VectorX direction(avi::SecantPairs& pairs, const VectorX& g, VectorX& with_pairs) {
  VectorX d(g.size());
  pairs.multiply(g.data(), with_pairs.data());
  pairs.direction(g.data(), with_pairs.data(), d.data());
  return d;
}

/// The BFGS inverse, formed: H+ = (I - rho s y^T) H (I - rho y s^T) + rho s s^T.
TEST(SecantPairs, GiveTheDirectionOfTheFormedMatrix) {
  constexpr Eigen::Index n = 11;
  constexpr int m = 4;
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      a(i, j) += 1.0 / static_cast<double>(i + j + 1);
  avi::SecantPairs pairs(m, n);
  const VectorX g = VectorX::LinSpaced(n, -1.0, 2.0);
  VectorX d(n), with_pairs(pairs.products());
  const auto direction_of = [&](const VectorX& gradient) {
    pairs.multiply(gradient.data(), with_pairs.data());
    const auto [slope, square] = pairs.direction(gradient.data(), with_pairs.data(), d.data());
    EXPECT_NEAR(slope, d.dot(gradient), 1e-12 * d.norm() * gradient.norm());
    EXPECT_NEAR(square, d.squaredNorm(), 1e-12 * square);
  };
  direction_of(g);
  EXPECT_EQ(d, VectorX(-g));
  std::vector<std::pair<VectorX, VectorX>> stored;
  for (int k = 0; k < 7; ++k) {  // more than there is room for
    VectorX s(n);
    for (Eigen::Index i = 0; i < n; ++i)
      s[i] = std::sin(1.0 + static_cast<double>(i * (k + 1)));
    const VectorX y = a * s;
    add_pair(pairs, s, y, y, with_pairs);
    stored.emplace_back(s, y);
    if (stored.size() > m) stored.erase(stored.begin());
    Eigen::MatrixXd h = Eigen::MatrixXd::Identity(n, n) * (s.dot(y) / y.squaredNorm());
    for (const auto& [si, yi] : stored) {
      const double rho = 1.0 / si.dot(yi);
      const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n) - rho * si * yi.transpose();
      h = left * h * left.transpose() + rho * si * si.transpose();
    }
    direction_of(g);
    EXPECT_EQ(pairs.size(), std::min(k + 1, m));
    EXPECT_LT((d + h * g).norm(), 1e-12 * d.norm()) << k;
    direction_of(y);
    EXPECT_LT((d + s).norm(), 1e-12 * s.norm()) << "secant equation, pair " << k;
  }
  pairs.clear();
  direction_of(g);
  EXPECT_EQ(d, VectorX(-g));
}

// Vectors are worked on in blocks that stay in the cache, pairs two at a time.
TEST(SecantPairs, SatisfyTheSecantEquationInEveryBlock) {
  constexpr Eigen::Index n = 9000;
  avi::SecantPairs pairs(3, n);
  VectorX with_pairs(pairs.products());
  const VectorX curvatures = VectorX::LinSpaced(n, 1.0, 3.0);
  for (int k = 1; k <= 3; ++k) {
    VectorX s(n);
    for (Eigen::Index i = 0; i < n; ++i)
      s[i] = std::sin(1.0 + static_cast<double>(i * k));
    const VectorX y = curvatures.cwiseProduct(s);
    add_pair(pairs, s, y, y, with_pairs);
    EXPECT_LT((direction(pairs, y, with_pairs) + s).norm(), 1e-12 * s.norm()) << k;
    // H is symmetric: y.H g = g.H y = g.s, and older pairs take part in H g.
    const VectorX g = VectorX::LinSpaced(n, -1.0, 2.0);
    EXPECT_NEAR(direction(pairs, g, with_pairs).dot(y), -g.dot(s), 1e-12 * g.norm() * s.norm()) << k;
  }
}

/// diag(1, 2, ...) as the Hessian, pairs along the axes.
struct Axes {
  static constexpr Eigen::Index n = 5;
  avi::SecantPairs pairs{3, n};
  VectorX with_pairs = VectorX::Zero(6 + 10);
  void write(Eigen::Index axis) {
    Eigen::Map<VectorX>(pairs.next_s(), n) = VectorX::Unit(n, axis);
    Eigen::Map<VectorX>(pairs.next_y(), n) = VectorX::Unit(n, axis) * static_cast<double>(axis + 1);
  }
  void store(Eigen::Index axis) {
    const VectorX s = VectorX::Unit(n, axis), y = s * static_cast<double>(axis + 1);
    add_pair(pairs, s, y, y, with_pairs);
  }
};

TEST(SecantPairs, TakeTheMassesWhereTheyForetellPairs) {
  // A diagonal Hessian from 1 to 1e4, of which twelve entries in two blocks matter: after some rounds the
  // masses are in use, and H is the BFGS inverse with them and not with I; a round of pairs of another
  // Hessian ends that.
  constexpr Eigen::Index n = 4800, every = 400;
  constexpr int m = 5;
  avi::SecantPairs pairs(m, n);
  VectorX curvatures(n), d(n), g(n), with_pairs(pairs.products());
  for (Eigen::Index i = 0; i < n; ++i)
    curvatures[i] = std::pow(1e4, static_cast<double>(i) / static_cast<double>(n - 1));
  int count = 0;
  std::vector<std::pair<VectorX, VectorX>> stored;
  const auto store = [&](bool against) {
    VectorX s = VectorX::Zero(n);
    for (Eigen::Index i = 0; i < n; i += every)
      s[i] = std::sin(1.0 + static_cast<double>(i / every * (count + 1))) / std::sqrt(curvatures[i]);
    ++count;
    const VectorX y = against ? VectorX(s.cwiseQuotient(curvatures)) : VectorX(s.cwiseProduct(curvatures));
    add_pair(pairs, s, y, g, with_pairs);
    stored.emplace_back(s, y);
    if (stored.size() > m) stored.erase(stored.begin());
    pairs.direction(g.data(), with_pairs.data(), d.data());  // with the products as commit() left them
    VectorX w = VectorX::Ones(n);
    if (pairs.weighted()) w = Eigen::Map<const VectorX>(pairs.inverse_masses(), n);
    VectorX q = g;
    std::vector<double> first;
    for (auto pair = stored.rbegin(); pair != stored.rend(); ++pair) {
      first.push_back(pair->first.dot(q) / pair->first.dot(pair->second));
      q -= first.back() * pair->second;
    }
    q = (s.dot(y) / y.dot(w.cwiseProduct(y))) * w.cwiseProduct(q);
    for (const auto& [si, yi] : stored) {
      q += (first.back() - yi.dot(q) / si.dot(yi)) * si;
      first.pop_back();
    }
    EXPECT_LT((d + q).norm(), 1e-11 * q.norm()) << "pair " << count;
  };
  for (Eigen::Index i = 0; i < n; ++i)
    g[i] = std::cos(static_cast<double>(i));
  for (int k = 0; k < 4 * m; ++k)
    store(false);
  EXPECT_TRUE(pairs.weighted());
  VectorX ratio(n / every);  // nearly a multiple of the inverse Hessian
  for (Eigen::Index i = 0; i < n / every; ++i)
    ratio[i] = pairs.inverse_masses()[i * every] * curvatures[i * every];
  EXPECT_LT(ratio.maxCoeff() / ratio.minCoeff(), 20.0);
  for (int k = 0; k < m; ++k)
    store(true);
  EXPECT_FALSE(pairs.weighted());
  pairs.clear();
  EXPECT_FALSE(pairs.weighted());
}

TEST(SecantPairs, ADiscardedPairTakesItsPlaceAndHasNoEffect) {
  Axes axes;
  const auto direction_along = [&](int axis) {
    return direction(axes.pairs, VectorX::Unit(5, axis), axes.with_pairs);
  };
  for (Eigen::Index axis : {3, 1, 0})
    axes.store(axis);
  EXPECT_EQ(direction_along(3), VectorX(-0.25 * VectorX::Unit(5, 3)));
  axes.write(4);  // over the oldest, of axis 3
  axes.pairs.discard();
  EXPECT_EQ(direction_along(1), VectorX(-0.5 * VectorX::Unit(5, 1)));
  EXPECT_EQ(direction_along(3), VectorX(-VectorX::Unit(5, 3)));  // gamma = 1, of axis 0
  EXPECT_EQ(direction_along(4), VectorX(-VectorX::Unit(5, 4)));
}

}  // namespace secant_pairs_test
