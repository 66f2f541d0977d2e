#pragma once
#include "avi/autodiff/program.hpp"
#include "avi/core/bracketed_root.hpp"
#include "src/autodiff/node_values.hpp"
#include "src/core/lowest.hpp"
#include "src/features/divisors.hpp"
#include "src/features/separable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

/// @file
/// The kinks of H, at which steps end.

namespace avi::detail {

/// The functions g(q, p) at whose zeros H changes to another formula: differences that its branches compare,
/// and arguments of its absolute values and signs. Steps end at these zeros, so that H is smooth within each
/// step.
class Kinks {
 public:
  /// A zero of function `index` between two parts of a step, the values of the function there, its place as
  /// the polynomial of the step has it, and the slope of the function there.
  struct Crossing {
    std::size_t index;
    double low, high, at_low, at_high;
    double place = 0.0, slope = 0.0;
  };

  /// The kinks of H, a node of a graph. @param timed whether the last coordinate is time; functions of time
  /// alone belong to Switches @return null where there are none
  static std::shared_ptr<const Kinks> of(const ExpressionGraph& graph, int energy, bool timed) {
    const std::vector<char> part = graph.parts(energy);
    const std::vector<unsigned char> on = dependences(graph, energy);
    const std::vector<char> under = singular(graph, part);
    std::vector<Function> found;
    for (int i = 0; i <= energy; ++i) {
      using enum Operation;
      const ExpressionGraph::Node& what = graph[i];
      if (!part[i] || on[i] == 0 || (timed && on[i] == on_last)) continue;
      const bool compares = what.operation == less || what.operation == less_equal;
      if (!(compares || what.operation == abs || what.operation == sign)) continue;
      found.push_back({what.a, compares ? what.b : -1, {}});
      if (under[i]) found.back().bases = bases_of(graph, part, i);
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    if (found.empty()) return nullptr;
    return std::make_shared<const Kinks>(graph, found);
  }
  /// A function, by its nodes: a difference of two, or a single one, where the second is -1.
  struct Function {
    int a, b;
    std::vector<int> bases;  ///< What H takes non-integer powers of that depend on it, see singular().
    friend auto operator<=>(const Function&, const Function&) = default;
  };
  Kinks(const ExpressionGraph& graph, const std::vector<Function>& functions) : at_(functions.size()) {
    std::vector<int> nodes;
    for (const auto& [a, b, bases] : functions) {
      places_.push_back({nodes.size(), b >= 0, bases.size()});
      nodes.push_back(a);
      if (b >= 0) nodes.push_back(b);
      nodes.insert(nodes.end(), bases.begin(), bases.end());
    }
    nodes_.emplace(graph, nodes);
  }

  static constexpr int parts = 4;  ///< Number of parts of a step, at whose ends the functions are looked at.

  /// Takes in the values of all functions at the end of part k, or at the beginning of the step for k = 0.
  void look(int k, const double* q, const double* p, Eigen::Index n) {
    nodes_->at(q, p, n);
    for (std::size_t i = 0; i < places_.size(); ++i)
      at_[i][static_cast<std::size_t>(k)] = value(i);
  }
  /// Value of function i at a point.
  double at(std::size_t i, const double* q, const double* p, Eigen::Index n) {
    nodes_->at(q, p, n);
    return value(i);
  }
  /// The first zero inside the step, as far as the points that were looked at show it; where a function seems
  /// to turn at zero between two of them, further points are looked at. A value that is zero to nine digits
  /// counts as having no sign; if it is the one at the beginning of the step, as after a step that was made
  /// to end at a zero, the sign shortly after is taken instead. A function that jumps over zero, as a
  /// difference does in which two terms change places, has no zero there; nor counts one at which the base of
  /// a non-integer power vanishes, see singular(). @param on on(i, c) is function i at the part c of the step
  template <class On>
  std::optional<Crossing> first(const On& on) {
    std::optional<Crossing> found;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      auto& at = at_[i];
      double largest = 0.0;
      for (const double x : at)
        largest = std::max(largest, std::abs(x));
      const auto has_sign = [&](double x) { return std::abs(x) > 1e-9 * largest; };
      Crossing part{i, 0.0, 0.0, at[0], 0.0};
      if (!has_sign(at[0])) part.low = soon, part.at_low = on(i, soon);
      const bool begins = part.at_low != 0.0;
      for (int k = 1; k <= parts; ++k) {
        part.high = static_cast<double>(k) / parts, part.at_high = at[static_cast<std::size_t>(k)];
        if (!has_sign(part.at_high)) continue;
        const auto here = [&](double c) { return on(i, c); };
        const bool turns =
            begins && part.at_low * part.at_high > 0.0 && turns_near_zero(at, k) && find_turn(part, here);
        if ((turns || part.at_low * part.at_high < 0.0) && find_zero(part, here) && !ends_there(part, here)) {
          if (!found || part.place < found->place) found = part;
          break;
        }
        part.low = part.high, part.at_low = part.at_high;
      }
    }
    return found;
  }

  /// Part of a step after which a function that is zero at its beginning has a sign.
  static constexpr double soon = 0x1p-17;

  /// Marks the nodes of which H takes a non-integer power, a root or a logarithm, directly or through other
  /// nodes. If its base vanishes with one, H may be smooth on neither side, and two runs whose steps end
  /// there would err alike.
  static std::vector<char> singular(const ExpressionGraph& graph, const std::vector<char>& part) {
    std::vector<char> found(part.size(), 0);
    for (int i = static_cast<int>(part.size()) - 1; i >= 0; --i) {
      using enum Operation;
      const auto& [operation, a, b, number] = graph[i];
      if (!part[i] || operation == input || operation == constant) continue;
      if (!(found[i] || is_singular_at_zero(graph, i))) continue;
      found[a] = 1;
      if (b >= 0) found[b] = 1;
    }
    return found;
  }

 private:
  /// The bases of non-integer powers in H that depend on a node.
  static std::vector<int> bases_of(const ExpressionGraph& graph, const std::vector<char>& part, int node) {
    std::vector<char> depends(part.size(), 0);
    depends[node] = 1;
    std::vector<int> bases;
    for (int i = node + 1; i < static_cast<int>(part.size()); ++i) {
      const auto& [operation, a, b, number] = graph[i];
      if (!part[i] || operation == Operation::input || operation == Operation::constant) continue;
      depends[i] = depends[a] || (b >= 0 && depends[b]);
      if (depends[a] && is_singular_at_zero(graph, i)) bases.push_back(a);
    }
    return bases;
  }
  /// Returns true if the base of a non-integer power vanishes at a zero, beside what it is a little before or
  /// behind.
  template <class F>
  bool ends_there(const Crossing& zero, const F& on) {
    const auto& [place, is_difference, count] = places_[zero.index];
    if (count == 0) return false;
    const std::size_t first = place + (is_difference ? 2 : 1), number = count;
    const auto bases_at = [&](double c) {
      (void)on(c);
      std::vector<double> bases;
      for (std::size_t k = 0; k < number; ++k)
        bases.push_back(std::abs((*nodes_)[first + k]));
      return bases;
    };
    const double aside = 1e-3 * (zero.high - zero.low);
    const auto at = bases_at(zero.place), before = bases_at(zero.place - aside),
               behind = bases_at(zero.place + aside);
    for (std::size_t k = 0; k < at.size(); ++k)
      if (!(at[k] > 1e-5 * std::max(before[k], behind[k]))) return true;
    return false;
  }
  /// Returns true if the polynomial through the values at all points comes near zero between the points k - 1
  /// and k, which have the same sign.
  static bool turns_near_zero(const std::array<double, parts + 1>& at, int k) {
    const double least = 0.1 * std::max(std::abs(at[static_cast<std::size_t>(k - 1)]),
                                        std::abs(at[static_cast<std::size_t>(k)]));
    const double sense = std::copysign(1.0, at[static_cast<std::size_t>(k)]);
    for (const double aside : {0.25, 0.5, 0.75}) {
      const double x = k - 1 + aside;
      double between = 0.0;  // by Lagrange's formula
      for (int i = 0; i <= parts; ++i) {
        double weight = 1.0;
        for (int j = 0; j <= parts; ++j)
          if (j != i) weight *= (x - j) / (i - j);
        between += weight * at[static_cast<std::size_t>(i)];
      }
      if (sense * between < least) return true;
    }
    return false;
  }
  /// Looks inside a part for a place where the function has another sign than at both ends. If there is one,
  /// the part is made to end there. @return true if there is one
  template <class F>
  static bool find_turn(Crossing& part, const F& on) {
    const double sense = std::copysign(1.0, part.at_low);
    const auto [place, least] = lowest([&](double c) { return sense * on(c); }, part.low, part.high, true);
    if (!(least < 0.0)) return false;
    part.high = place, part.at_high = sense * least;
    return true;
  }

  /// Finds the zero in a part at whose ends the function has different signs, and its slope there. @return
  /// false if it jumps over zero instead
  template <class F>
  static bool find_zero(Crossing& part, const F& on) {
    const double sense = std::copysign(1.0, part.at_high);
    const auto along = [&](double c) { return sense * on(c); };
    const Root root = bracketed_root(along, part.low, sense * part.at_low, part.high, sense * part.at_high,
                                     1e-9 * std::abs(part.at_high - part.at_low));
    const double wide = 1e-3 * (part.high - part.low);
    part.place = root.x;
    part.slope = sense * (along(root.x + wide) - along(root.x - wide)) / (2.0 * wide);
    return root.met;
  }

  [[nodiscard]] double value(std::size_t i) const {
    const auto& [place, is_difference, bases] = places_[i];
    return is_difference ? (*nodes_)[place] - (*nodes_)[place + 1] : (*nodes_)[place];
  }
  struct Places {  // places in the list: of one node or two, then of the bases
    std::size_t first;
    bool is_difference;
    std::size_t bases;
  };
  std::vector<Places> places_;
  std::vector<std::array<double, parts + 1>> at_;  // values in the current step
  std::optional<NodeValues<>> nodes_;
};

}  // namespace avi::detail
