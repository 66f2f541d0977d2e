#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/core/bracketed_root.hpp"
#include "src/autodiff/node_values.hpp"
#include "src/features/divisors.hpp"
#include "src/features/separable.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

/// @file
/// Places that no orbit crosses, because H is infinite there.

namespace avi::detail {

/// The divisors of H, functions of coordinates alone, that may change their sign: a radius, the sine of an
/// angle from a pole of the coordinates. Where one is zero, H is infinite, unless what it divides vanishes
/// there, too. A step from one side to the other has jumped over such a place, which may be far thinner than
/// the step, so that comparing two runs does not show it.
class Barriers {
 public:
  /// The barriers of H, a node of a graph of (q, p); null if there are none.
  static std::shared_ptr<const Barriers> of(const ExpressionGraph& graph, int energy) {
    const auto all = static_cast<std::size_t>(energy) + 1;
    std::vector<int> nodes = divisors(graph, energy, dependences(graph, energy), all);
    if (nodes.empty()) return nullptr;
    const std::vector<double> least = lower_bounds(graph, *std::ranges::max_element(nodes));
    std::erase_if(nodes, [&](int node) { return least[node] >= 0.0; });
    if (nodes.empty()) return nullptr;
    return std::make_shared<const Barriers>(Barriers{graph, nodes});
  }

  /// Returns true if a barrier lies between two points (q, p), on the straight way from one to the other.
  /// @param energy gives H at a point of 2n numbers
  template <class Energy>
  bool between(const double* from, const double* to, const Energy& energy) {
    divisors_.at(from, from + n_, n_);
    before_.resize(divisors_.size());
    for (std::size_t k = 0; k < before_.size(); ++k)
      before_[k] = divisors_[k];
    divisors_.at(to, to + n_, n_);
    for (std::size_t k = 0; k < before_.size(); ++k)
      if (before_[k] * divisors_[k] < 0.0) crossed_.push_back({k, before_[k], divisors_[k]});
    bool any = false;
    for (; !crossed_.empty(); crossed_.pop_back())
      any = any || is_infinite(crossed_.back(), from, to, energy);
    return any;
  }

 private:
  struct Crossed {
    std::size_t divisor;
    double before, after;
  };
  Barriers(const ExpressionGraph& graph, const std::vector<int>& nodes)
      : n_(graph.inputs() / 2), divisors_(graph, nodes) {}

  /// Returns true if H grows as at a pole towards the zero of a divisor. Beside a zero of what it divides,
  /// too, H is smooth; towards the zero of a logarithm, it grows by a few tens only.
  template <class Energy>
  bool is_infinite(const Crossed& it, const double* from, const double* to, const Energy& energy) {
    const auto place = [&](double part) {
      there_.resize(static_cast<std::size_t>(2 * n_));
      for (std::size_t i = 0; i < there_.size(); ++i)
        there_[i] = from[i] + part * (to[i] - from[i]);
      return there_.data();
    };
    const double sign = std::copysign(1.0, it.after);
    const auto value = [&](double part) {
      const double* const z = place(part);
      divisors_.at(z, z + n_, n_);
      return sign * divisors_[it.divisor];
    };
    const double root = bracketed_root(value, 0.0, sign * it.before, 1.0, sign * it.after, 0.0).x;
    constexpr double aside = 1e-3, beside = 1e-14;  // parts of the way
    const auto at = [&](double part) { return energy(place(part)); };
    const double left = at(root - aside), right = at(root + aside),
                 around = std::abs(left - at(root - 2.0 * aside)) + std::abs(right - at(root + 2.0 * aside)) +
                          1e-12 * std::abs(left);
    const double nearest = std::max(std::abs(at(root - beside) - left), std::abs(at(root + beside) - right));
    return !(nearest <= 1e4 * around);
  }

  int n_;
  NodeValues<> divisors_;
  std::vector<double> before_, there_;
  std::vector<Crossed> crossed_;
};

}  // namespace avi::detail
