#include "avi/collocation/gauss_rule.hpp"

#include <cmath>
#include <vector>

namespace avi {

namespace {

// Coefficients of Legendre's recurrence: (2 k + 1) / (k + 1) and k / (k + 1).
constexpr std::array<std::array<double, 2>, GaussRule::most> ratio = [] {
  std::array<std::array<double, 2>, GaussRule::most> all{};
  for (int k = 0; k < GaussRule::most; ++k)
    all[k] = {(2.0 * k + 1.0) / (k + 1.0), k / (k + 1.0)};
  return all;
}();

}  // namespace

GaussRule::Row GaussRule::quick_integrals(double c) const {
  // int_0^c P_k = 2 c (c - 1) P_k'(2 c - 1) / (k (k + 1)) keeps its digits at both ends.
  const double x = 2.0 * c - 1.0;
  double before = 1.0, now = x, slope_before = 0.0, slope = 1.0;  // P_{k-1}, P_k and their derivatives
  Row row{};
  for (int k = 1; k < stages_; ++k) {
    for (int j = 0; j < stages_; ++j)
      row[j] += table_->slopes[k][j] * slope;
    const double next = ratio[k][0] * x * now - ratio[k][1] * before;
    const double next_slope = slope_before + (2 * k + 1) * now;
    before = now, now = next;
    slope_before = slope, slope = next_slope;
  }
  for (int j = 0; j < stages_; ++j)
    row[j] = c * (1.0 + (c - 1.0) * row[j]);
  return row;
}

GaussRule::Table::Table(int s) : stages(s) {
  for (int i = 0; i < s; ++i)
    find_node(i);
  const Row end = integrals(1);
  for (int i = 0; i < s; ++i) {
    const Row row = integrals(exact_node[i]), next = integrals(1.0 + node[i]);
    for (int j = 0; j < s; ++j) {
      mu[i][j] = row[j];
      ahead[i][j] = next[j] - end[j];
    }
  }
  // Each pair has the sum 1. Its larger number is at least 1/2, so one minus it is exact.
  for (int i = 0; i < s; ++i) {
    mu[i][i] = 0.5;
    for (int j = 0; j < i; ++j)
      if (mu[i][j] >= mu[j][i])
        mu[j][i] = 1.0 - mu[i][j];
      else
        mu[i][j] = 1.0 - mu[j][i];
  }
}

GaussRule::Row GaussRule::Table::integrals(long double c) const {
  // l_j / b_j = sum_k (2 k + 1) P_k(c_j) P_k, with shifted Legendre polynomials P_k, since the rule is
  // exact.
  const Polynomials p = legendre(2 * c - 1);
  std::array<long double, most> integral{c};
  for (int k = 1; k < stages; ++k)
    integral[k] = (p[k + 1] - p[k - 1]) / (2 * (2 * k + 1));
  Row row{};
  for (int j = 0; j < stages; ++j) {
    long double sum = 0;
    for (int k = 0; k < stages; ++k)
      sum += series[j][k] * integral[k];
    row[j] = static_cast<double>(sum);
  }
  return row;
}

GaussRule::Table::Polynomials GaussRule::Table::legendre(long double x) const {
  Polynomials p{1, x};
  for (int k = 1; k < stages; ++k)
    p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
  return p;
}

void GaussRule::Table::find_node(int i) {
  long double x = -std::cos(M_PI * (i + 0.75) / (stages + 0.5)), slope = 1;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Polynomials p = legendre(x);
    slope = stages * (x * p[stages] - p[stages - 1]) / (x * x - 1);
    x -= p[stages] / slope;
  }
  exact_node[i] = (1 + x) / 2;
  node[i] = static_cast<double>(exact_node[i]);
  weight[i] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
  const Polynomials p = legendre(x);
  last_legendre[i] = static_cast<double>(p[stages - 1]);
  for (int k = 0; k < stages; ++k)
    series[i][k] = (2 * k + 1) * p[k];
  for (int k = 1; k < stages; ++k)
    slopes[k][i] = static_cast<double>(2 * series[i][k] / (k * (k + 1)));
}

const GaussRule& detail::collocation_rule(int order, int largest, SweepSettings settings) {
  require(order >= 2 && order <= largest && order % 2 == 0, "Order of collocation", order, "even and in [2, ",
          largest, largest < 32 ? "]; collocation<32>(problem, order) goes up to 32" : "]");
  require(std::isfinite(settings.tolerance) && settings.tolerance > 0.0, "Tolerance of the sweeps",
          settings.tolerance, "finite and positive");
  require(settings.max_sweeps >= 1, "Number of sweeps", settings.max_sweeps, "at least 1");
  static const std::vector<GaussRule> rules = [] {
    std::vector<GaussRule> all;
    for (int s = 1; s <= GaussRule::most; ++s)
      all.emplace_back(s);
    return all;
  }();
  return rules[static_cast<std::size_t>(order / 2 - 1)];
}

}  // namespace avi
