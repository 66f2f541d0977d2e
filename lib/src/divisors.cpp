#include "divisors.hpp"

#include "separable.hpp"

#include <array>
#include <utility>

namespace avi::detail {

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
      case exp:  // these never vanish
      case cosh:
        break;
      default:
        if (divides) found.push_back(at);
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

}  // namespace avi::detail
