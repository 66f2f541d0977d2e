#include "src/features/divisors.hpp"

#include "src/features/separable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace avi::detail {

namespace {

// Power of a logarithm, for use in sums: smaller than any power that has a meaning.
constexpr double nearly_none = 1e-9;

}  // namespace

std::vector<int> divisors(const ExpressionGraph& graph, int energy, const std::vector<unsigned char>& on,
                          std::size_t most) {
  const std::vector<char> part = graph.parts(energy);
  std::vector<int> found;
  // Nodes that have been looked at, as divisors, and as what divides these.
  std::array<std::vector<char>, 2> seen{std::vector<char>(part.size(), 0), std::vector<char>(part.size(), 0)};
  const auto take_factors = [&](int node) {
    std::vector<std::pair<int, bool>> open{{node, true}};
    while (!open.empty() && found.size() <= most) {
      const auto [at, divides] = open.back();
      open.pop_back();
      if (on[at] == 0 || (on[at] & on_p) != 0 || std::exchange(seen[divides][at], 1)) continue;
      const ExpressionGraph::Node& what = graph[at];
      switch (what.operation) {
        using enum Operation;
      case power:
        open.emplace_back(what.a, divides == (graph[what.b].number > 0.0));
        break;
      case multiply:
        open.emplace_back(what.b, divides);
        [[fallthrough]];
      case sqrt:
      case abs:
      case divide:
        open.emplace_back(what.a, divides);
        break;
      default:
        if (divides && !has(what.operation, shapes::positive)) found.push_back(at);
      }
    }
  };
  for (int i = 0; i <= energy && found.size() <= most; ++i) {
    const ExpressionGraph::Node& what = graph[i];
    if (!part[i]) continue;
    if (what.operation == Operation::divide)
      take_factors(what.b);
    else if (what.operation == Operation::log)
      take_factors(what.a);
    else if (what.operation == Operation::power && graph[what.b].number < 0.0)
      take_factors(what.a);
  }
  return found;
}

bool is_singular_at_zero(const ExpressionGraph& graph, int node) {
  using enum Operation;
  const ExpressionGraph::Node& what = graph[node];
  return what.operation == sqrt || what.operation == log ||
         (what.operation == power && std::trunc(graph[what.b].number) != graph[what.b].number);
}

void follow_powers(const ExpressionGraph& graph, std::vector<double>& powers, std::size_t from,
                   double (*otherwise)(Operation, double, double)) {
  for (std::size_t i = from; i < powers.size(); ++i) {
    const ExpressionGraph::Node& what = graph[static_cast<int>(i)];
    if (what.operation == Operation::input || what.operation == Operation::constant) continue;
    const double a = powers[what.a], b = what.b < 0 ? 0.0 : powers[what.b];
    switch (what.operation) {
      using enum Operation;
    case multiply:
      powers[i] = a + b;
      break;
    case divide:
      powers[i] = a - b;
      break;
    case power:
      powers[i] = a * graph[what.b].number;
      break;
    case sqrt:
      powers[i] = 0.5 * a;
      break;
    default:
      powers[i] = otherwise(what.operation, a, b);
    }
  }
}

double power_in(const ExpressionGraph& graph, int node, int base) {
  std::vector<double> powers(static_cast<std::size_t>(node) + 1, 0.0);
  powers[base] = 1.0;
  follow_powers(graph, powers, static_cast<std::size_t>(base) + 1,
                [](Operation operation, double a, double b) {
                  using enum Operation;
                  if (operation == add || operation == subtract) return std::min(a, b);
                  if (operation == log) return a > 0.0 ? -nearly_none : 0.0;
                  if (operation == when) return b;
                  return has(operation, shapes::vanishes) && a > 0.0 ? a : 0.0;
                });
  return powers[node];
}

std::vector<double> degrees_of(const ExpressionGraph& graph, int node) {
  std::vector<double> degrees;
  degrees.reserve(static_cast<std::size_t>(node) + 1);
  for (int i = 0; i <= node; ++i)
    degrees.push_back(graph[i].operation == Operation::input ? 1.0 : 0.0);
  follow_powers(graph, degrees, 0, [](Operation, double a, double b) { return std::max(a, b); });
  for (double& degree : degrees)
    degree = std::max(degree, 1.0);
  return degrees;
}

std::vector<double> lower_bounds(const ExpressionGraph& graph, int node) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<double> least(static_cast<std::size_t>(node) + 1, none);
  for (int i = 0; i <= node; ++i) {
    const auto& [operation, a, b, number] = graph[i];
    switch (operation) {
      using enum Operation;
    case constant:
      least[i] = number;
      break;
    case add:
      least[i] = least[a] + least[b];
      break;
    case multiply:
      if (a == b || (least[a] >= 0.0 && least[b] >= 0.0)) least[i] = 0.0;
      if (least[a] > 0.0 && least[b] > 0.0) least[i] = least[a] * least[b];
      break;
    case divide:
      if (least[a] >= 0.0 && least[b] >= 0.0) least[i] = 0.0;
      break;
    case power:
      if (least[a] >= 0.0 || std::fmod(graph[b].number, 2.0) == 0.0) least[i] = 0.0;
      break;
    case sqrt:
    case abs:
    case exp:
      least[i] = 0.0;
      break;
    case cosh:
      least[i] = 1.0;
      break;
    case hypot:
      for (const int operand : {a, b})
        least[i] = std::max(least[i], graph.is_constant(operand) ? std::abs(graph[operand].number) : 0.0);
      break;
    default:
      break;
    }
  }
  return least;
}

}  // namespace avi::detail
