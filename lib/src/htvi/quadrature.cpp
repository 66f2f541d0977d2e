#include "avi/htvi/quadrature.hpp"

#include "avi/core/require.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace avi {

namespace {

/// Legendre polynomial P_m at x in [-1, 1].
double legendre(int m, double x) {
  double before = 1.0, p = m == 0 ? 1.0 : x;
  for (int k = 2; k <= m; ++k)
    before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
  return p;
}

/// All simple zeros of f inside (-1, 1), by bisection between the sign changes on a grid.
template <class F>
std::vector<double> zeros(const F& f) {
  constexpr int cells = 4000;  // from middle to middle, since f may vanish at the ends
  std::vector<double> roots;
  for (int i = 1; i < cells; ++i) {
    double low = (2.0 * i - 1.0) / cells - 1.0, high = (2.0 * i + 1.0) / cells - 1.0;
    const bool rising = f(low) < 0.0;
    if ((f(high) < 0.0) == rising) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((f(middle) < 0.0) == rising ? low : high) = middle;
    }
    roots.push_back(0.5 * (low + high));
  }
  return roots;
}

/// The rule with given nodes in [-1, 1] and weights on [0, 1].
template <class Weight>
Quadrature from_nodes(std::string name, int order, const std::vector<double>& nodes, const Weight& weight) {
  Quadrature rule{std::move(name), order, {}, {}};
  for (double x : nodes) {
    rule.nodes.push_back(0.5 * (1.0 + x));
    rule.weights.push_back(weight(x));
  }
  return rule;
}

}  // namespace

Quadrature rectangle_left() { return {"rectangle", 1, {0.0}, {1.0}}; }

Quadrature midpoint() { return {"midpoint", 2, {0.5}, {1.0}}; }

Quadrature trapezoid() { return {"trapezoid", 2, {0.0, 1.0}, {0.5, 0.5}}; }

Quadrature simpson() { return {"simpson", 4, {0.0, 0.5, 1.0}, {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0}}; }

Quadrature boole() {
  return {"boole",
          6,
          {0.0, 0.25, 0.5, 0.75, 1.0},
          {7.0 / 90.0, 16.0 / 45.0, 2.0 / 15.0, 16.0 / 45.0, 7.0 / 90.0}};
}

Quadrature gauss(int m) {
  require(m >= 1 && m <= 16, "Number of Gauss nodes", m, "in [1, 16]");
  const auto weight = [=](double x) {
    double sum = 0.0;  // Christoffel's number is one over the sum of the squared orthonormal polynomials
    for (int k = 0; k < m; ++k)
      sum += (2 * k + 1) * std::pow(legendre(k, x), 2);
    return 1.0 / sum;
  };
  return from_nodes("gauss" + std::to_string(m), 2 * m, zeros([=](double x) { return legendre(m, x); }),
                    weight);
}

Quadrature lobatto(int m) {
  require(m >= 2 && m <= 16, "Number of Lobatto nodes", m, "in [2, 16]");
  // (1 - x^2) P'_(m-1)(x) = (m - 1) (P_(m-2)(x) - x P_(m-1)(x)) vanishes at the nodes.
  auto nodes = zeros([=](double x) { return legendre(m - 2, x) - x * legendre(m - 1, x); });
  nodes.insert(nodes.begin(), -1.0);
  nodes.push_back(1.0);
  const auto weight = [=](double x) { return 1.0 / (m * (m - 1) * std::pow(legendre(m - 1, x), 2)); };
  return from_nodes("lobatto" + std::to_string(m), 2 * m - 2, nodes, weight);
}

Quadrature radau(int m) {
  require(m >= 1 && m <= 16, "Number of Radau nodes", m, "in [1, 16]");
  auto nodes = zeros([=](double x) { return legendre(m - 1, x) + legendre(m, x); });
  nodes.insert(nodes.begin(), -1.0);
  const auto weight = [=](double x) { return (1.0 - x) / (2 * m * m * std::pow(legendre(m - 1, x), 2)); };
  return from_nodes("radau" + std::to_string(m), 2 * m - 1, nodes, weight);
}

void validate(const Quadrature& rule) {
  require(!rule.nodes.empty(), "Number of quadrature nodes", rule.nodes.size(), "at least 1");
  require(rule.nodes.size() == rule.weights.size(), "Number of quadrature weights", rule.weights.size(),
          "the number of nodes, ", rule.nodes.size());
  for (double c : rule.nodes)
    require(c >= 0.0 && c <= 1.0, "A quadrature node", c, "in [0, 1]");
  const std::size_t most = 2 * rule.nodes.size();
  require(rule.order >= 1 && static_cast<std::size_t>(rule.order) <= most, "Order of the quadrature",
          rule.order, "at least 1 and at most twice the number of nodes, ", most);
  std::vector<double> terms = rule.weights;
  for (int k = 1; k <= rule.order; ++k) {
    const double sum = std::accumulate(terms.begin(), terms.end(), 0.0);
    if (k == 1) require(std::abs(sum - 1.0) < 1e-12, "Sum of the quadrature weights", sum, "1");
    require(std::abs(sum - 1.0 / k) < 1e-12, "Order of the quadrature", rule.order, "at most ", k - 1,
            ", the first power that it does not integrate");
    for (std::size_t i = 0; i < terms.size(); ++i)
      terms[i] *= rule.nodes[i];
  }
}

}  // namespace avi
