#pragma once
#include "avi/autodiff/recording.hpp"
#include "candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// @file
/// Features of H that a step may jump over: walls and bells thinner than the way from stage to stage.

namespace avi::detail {

/// The arguments of all functions in H that change within a narrow range of their argument only: exp, tanh,
/// cosh, erf and the like. The arguments are smooth on the way where the functions are not, so that a peak or
/// a passage through zero between two points can be found from them.
class SharpFeatures {
 public:
  /// Takes H as a node of a graph. @param sketch of the orbit, where it begins
  SharpFeatures(const ExpressionGraph& graph, int energy, const Sketch& sketch) {
    const std::vector<char> part = graph.parts(energy);
    for (int i = 0; i <= energy; ++i) {
      using enum Operation;
      const Operation what = graph[i].operation;
      const bool peak = what == exp,
                 passage = what == tanh || what == cosh || what == sinh || what == erf || what == erfc;
      if (!part[static_cast<std::size_t>(i)] || !(peak || passage)) continue;
      const int n = graph.inputs() / 2;
      arguments_.push_back({peak, n, {Recording(graph, graph[i].a).value()}});
      for (const Sketch::Sample& sample : sketch.samples)
        arguments_.back().add(arguments_.back()(sample.z.data(), sample.z.data() + n));
    }
  }

  /// H has no such function.
  [[nodiscard]] bool none() const { return arguments_.empty(); }

  /// Some feature lies inside the last step of `method`, between points that do not show it.
  bool jumped(const OrbitSteps& method, const State<dynamic>& before, const State<dynamic>& after) {
    bool any = false;
    for (Argument& argument : arguments_) {
      argument.add(argument(after));
      any = any || argument.moves();
    }
    if (!any) return false;
    constexpr int parts = 4;
    std::array<State<dynamic>, parts + 1> on_the_way;
    for (int k = 1; k < parts; ++k)
      on_the_way[k] = method.polynomial(static_cast<double>(k) / parts);
    on_the_way[0] = before;
    on_the_way[parts] = after;
    for (Argument& argument : arguments_) {
      if (!argument.moves()) continue;
      std::array<double, parts + 1> at;
      for (int k = 0; k <= parts; ++k)
        at[k] = argument(on_the_way[k]);
      const auto [least, most] = std::ranges::minmax_element(at);
      if (!(*most - *least > wide)) continue;
      if (argument.peak) {
        const auto k = static_cast<int>(most - at.begin());
        // From e^-40 on it may be felt. A smooth top lies hardly further above three points than they differ.
        const int first = std::clamp(k - 1, 0, parts - 2);
        const double low = std::min({at[first], at[first + 1], at[first + 2]});
        if (*most + 2.0 * (*most - low) < -40.0) continue;
        const double place = highest(method, argument, std::max(k - 1, 0) / static_cast<double>(parts),
                                     std::min(k + 1, parts) / static_cast<double>(parts));
        const double top = argument(method.polynomial(place));
        // Stages an eighth of a step away would have to see something of it.
        for (const double side : {std::max(place - 0.125, 0.0), std::min(place + 0.125, 1.0)})
          if (top > -40.0 && top - argument(method.polynomial(side)) > 12.0) return true;
      } else {
        for (int k = 0; k < parts; ++k)  // a point may lie on the zero itself
          if (at[k] * at[k + 1] <= 0.0 && std::abs(at[k + 1] - at[k]) > 8.0) return true;
      }
    }
    return false;
  }

 private:
  static constexpr double wide = 30.0;  // a change of the argument that a step may not make unseen
  struct Argument {
    bool peak;
    int n;
    RecordedFormula<double> formula;
    double low = infinity, high = -infinity;  // on the sketch and after all steps

    double operator()(const State<dynamic>& z) { return (*this)(z.q.data(), z.p.data()); }
    double operator()(const double* q, const double* p) {
      formula.run(q, p, n);
      return formula.value();
    }
    void add(double value) { low = std::min(low, value), high = std::max(high, value); }
    // So far by so much that a step might hide a change that is wide.
    [[nodiscard]] bool moves() const { return !(high - low <= wide / 3.0); }
  };

  /// Where it is largest in a part of the step, by golden section.
  static double highest(const OrbitSteps& method, Argument& argument, double low, double high) {
    constexpr double golden = 0.6180339887498949;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = argument(method.polynomial(a)), at_b = argument(method.polynomial(b));
    for (int i = 0; i < 30; ++i) {
      if (at_a > at_b) {
        high = b, b = a, at_b = at_a;
        a = high - golden * (high - low);
        at_a = argument(method.polynomial(a));
      } else {
        low = a, a = b, at_a = at_b;
        b = low + golden * (high - low);
        at_b = argument(method.polynomial(b));
      }
    }
    return 0.5 * (low + high);
  }

  std::vector<Argument> arguments_;
};

}  // namespace avi::detail
