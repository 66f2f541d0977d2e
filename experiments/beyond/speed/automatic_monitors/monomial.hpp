#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

/// @file
/// Formulas that are a power of one of their parts.

namespace experiment {

using avi::ExpressionGraph, avi::Operation;

/// Finds out that a formula is a number times a power of another one, by their values at a few points: second
/// derivatives of 1/r, squared and summed, are a number times r^-6, at a tenth of the price.
class Monomial {
 public:
  /// In this graph, near this point of phase space.
  Monomial(ExpressionGraph& graph, const std::vector<double>& point) : graph_(graph) {
    const std::size_t half = point.size() / 2;
    double sizes[2] = {0.0, 0.0};  // of positions and momenta
    for (std::size_t i = 0; i < point.size(); ++i)
      sizes[i / half] += std::abs(point[i]) / static_cast<double>(half);
    std::int64_t random = 1;  // Park and Miller's generator, for <random> is long to compile
    for (int k = 0; k < 6; ++k) {
      std::vector<double> near = point;
      for (std::size_t i = 0; i < near.size(); ++i) {
        random = random * 48271 % 2147483647;
        near[i] += 0.2 * (sizes[i / half] > 0.0 ? sizes[i / half] : 1.0) *
                   (static_cast<double>(random) / 2147483647.0 - 0.5);
      }
      points_.push_back(std::move(near));
    }
  }

  /// A cheaper node with the value of `formula`, which is not negative: a number times a power of a part of
  /// `whole`, alone or times the square of `whole`; `formula` itself where there is none.
  int simplified(int formula, int whole) {
    if (graph_.is_constant(formula)) return formula;
    const std::vector<char> part = graph_.parts(whole);
    for (const bool squared : {false, true}) {
      std::optional<Power> best;
      for (int base = 0; base <= whole; ++base)
        if (part[base] && !graph_.is_constant(base))
          if (const auto power = power_of(formula, base, squared ? whole : -1);
              power && (!best || power->price() < best->price()))
            best = power;
      if (!best) continue;
      const int bare = graph_.binary(Operation::multiply, graph_.constant(best->factor),
                                     raised(best->base, best->exponent));
      return squared
                 ? graph_.binary(Operation::multiply, graph_.binary(Operation::multiply, whole, whole), bare)
                 : bare;
    }
    return formula;
  }

 private:
  using Values = std::vector<double>;  // of the nodes at a point, from the first one on
  struct Power {
    int base;
    double exponent, factor;
    /// Whole powers before roots, small ones before large ones.
    [[nodiscard]] double price() const {
      return std::abs(exponent) + (exponent == std::round(exponent) ? 0.0 : 100.0);
    }
  };

  /// formula (over the square of a node) as a power of a base.
  std::optional<Power> power_of(int formula, int base, int over) {
    const auto at = [&](Values& values, int node) { return avi::detail::evaluate(graph_, node, values); };
    const auto value = [&](Values& values) {
      const double square = over < 0 ? 1.0 : std::pow(at(values, over), 2);
      return at(values, formula) / square;
    };
    const double f0 = value(points_[0]), f1 = value(points_[1]), u0 = at(points_[0], base),
                 u1 = at(points_[1], base);
    const double spread = std::log(u1 / u0);  // what is not a number, of 0 or of two signs, passes no test
    if (!(std::abs(spread) > 1e-4)) return {};
    const double seen = std::log(f1 / f0) / spread, exponent = 0.25 * std::round(4.0 * seen);
    const bool even = std::fmod(exponent, 2.0) == 0.0;
    if (!(std::abs(seen - exponent) < 1e-6) || std::abs(exponent) > 64.0) return {};
    const double factor = f0 / std::pow(std::abs(u0), exponent);
    for (Values& values : points_) {
      const double u = at(values, base), expected = factor * std::pow(std::abs(u), exponent);
      if (!(even || u > 0.0) || !(std::abs(value(values) - expected) <= 1e-9 * expected)) return {};
    }
    return Power{base, exponent, factor};
  }

  /// Powers above 8 by products of those below, which go several numbers at a time.
  int raised(int base, double exponent) {
    if (std::abs(exponent) <= 8.0 || exponent != std::round(exponent)) return graph_.power(base, exponent);
    const double sign = exponent < 0.0 ? -1.0 : 1.0, half = exponent / 2.0;
    if (half == std::round(half)) {
      const int root = raised(base, half);
      return graph_.binary(Operation::multiply, root, root);
    }
    return graph_.binary(Operation::multiply, graph_.power(base, sign), raised(base, exponent - sign));
  }

  ExpressionGraph& graph_;
  std::vector<Values> points_;
};

}  // namespace experiment
