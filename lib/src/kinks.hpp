#pragma once
#include "avi/autodiff/program.hpp"
#include "schedule.hpp"
#include "separable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

/// @file
/// Where H has a kink.

namespace avi::detail {

/// The functions g(q, p) at whose zeros H goes over to another formula: differences that its branches
/// compare, and what it takes the absolute value or the sign of. A step ends at a zero, so that H is smooth
/// in every one.
class Kinks {
 public:
  /// A zero of function `index` between two parts of a step, where it has these values.
  struct Crossing {
    std::size_t index;
    double low, high, at_low, at_high;
  };

  /// Those of H as a node of a graph. @param timed the last coordinate is time, and functions of that alone
  /// are Switches @return null where there are none
  static std::shared_ptr<const Kinks> of(const ExpressionGraph& graph, int energy, bool timed) {
    const std::vector<char> part = graph.parts(energy);
    const std::vector<unsigned char> on = dependences(graph, energy);
    const std::vector<char> excluded = singular(graph, part);
    std::vector<std::pair<int, int>> found;  // differences of two nodes, or one
    for (int i = 0; i <= energy; ++i) {
      using enum Operation;
      const ExpressionGraph::Node& what = graph[i];
      if (!part[i] || on[i] == 0 || (timed && on[i] == on_last)) continue;
      const bool compares = what.operation == less || what.operation == less_equal;
      if (!(compares || what.operation == abs || what.operation == sign) || excluded[i]) continue;
      found.emplace_back(what.a, compares ? what.b : -1);
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    if (found.empty() || found.size() > most) return nullptr;
    return std::make_shared<const Kinks>(graph, found);
  }
  /// Differences of two nodes of a graph, or one where the second is -1.
  Kinks(const ExpressionGraph& graph, const std::vector<std::pair<int, int>>& differences)
      : at_(differences.size()) {
    std::vector<int> nodes;
    for (const auto& [a, b] : differences) {
      places_.emplace_back(static_cast<int>(nodes.size()), b >= 0);
      nodes.push_back(a);
      if (b >= 0) nodes.push_back(b);
    }
    formula_.emplace(RecordedFormula<double>{Schedule::program(graph, -1, nodes, graph.size())});
  }

  static constexpr int parts = 4;  ///< Number of parts of a step, at whose ends the functions are looked at.

  /// Takes in all functions at the end of part k, or at the beginning of the step for 0.
  void look(int k, const double* q, const double* p, Eigen::Index n) {
    formula_->run(q, p, n);
    for (std::size_t i = 0; i < places_.size(); ++i)
      at_[i][static_cast<std::size_t>(k)] = value(i);
  }
  /// Function i at a point.
  double at(std::size_t i, const double* q, const double* p, Eigen::Index n) {
    formula_->run(q, p, n);
    return value(i);
  }
  /// The first zero inside the step, as far as the points that were looked at tell. What is zero to nine
  /// digits at one of them, as at the end of a step that was made to lead there, has no sign there.
  [[nodiscard]] std::optional<Crossing> first() const {
    std::optional<Crossing> found;
    double earliest = 2.0;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const auto& at = at_[i];
      double largest = 0.0;
      for (const double x : at)
        largest = std::max(largest, std::abs(x));
      int last = -1;  // with a sign
      for (int k = 0; k <= parts; ++k) {
        const double here = at[static_cast<std::size_t>(k)];
        if (!(std::abs(here) > 1e-9 * largest)) continue;
        const double before = last < 0 ? here : at[static_cast<std::size_t>(last)];
        if (before * here < 0.0) {
          const double place = (last + (k - last) * before / (before - here)) / parts;
          if (place < earliest) {
            earliest = place;
            found =
                Crossing{i, static_cast<double>(last) / parts, static_cast<double>(k) / parts, before, here};
          }
          break;
        }
        last = k;
      }
    }
    return found;
  }

 private:
  static constexpr std::size_t most = 200;  // more of them leave no step whole

  /// The nodes of which H takes a broken power, a root or a logarithm, or of what depends on them: beyond a
  /// zero it may be smooth on neither side, and two runs whose steps end there would err alike.
  static std::vector<char> singular(const ExpressionGraph& graph, const std::vector<char>& part) {
    std::vector<char> found(part.size(), 0);
    for (int i = static_cast<int>(part.size()) - 1; i >= 0; --i) {
      using enum Operation;
      const auto& [operation, a, b, number] = graph[i];
      if (!part[i] || operation == input || operation == constant) continue;
      const bool broken = operation == power && std::trunc(graph[b].number) != graph[b].number;
      if (!(found[i] || operation == sqrt || operation == log || broken)) continue;
      found[a] = 1;
      if (b >= 0) found[b] = 1;
    }
    return found;
  }

  [[nodiscard]] double value(std::size_t i) const {
    const auto& [place, is_difference] = places_[i];
    const double first = formula_->partial(place);
    return is_difference ? first - formula_->partial(place + 1) : first;
  }
  std::vector<std::pair<int, bool>> places_;        // in the formula
  std::vector<std::array<double, parts + 1>> at_;   // in the step under way
  std::optional<RecordedFormula<double>> formula_;  // of all nodes, as derivatives of nothing
};

}  // namespace avi::detail
