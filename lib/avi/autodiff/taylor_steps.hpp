#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// How the Taylor series of the nodes of a formula follow from each other.

namespace avi {

/// The steps that give the Taylor series of all nodes that chosen outputs need, whatever the scalar of the
/// coefficients, and where each series lies in one array of them: see TaylorSeries.
class TaylorSteps {
 public:
  /// How the coefficients c of a node follow from those of its operands a and b; `number` stands for the one
  /// that is constant.
  enum class Rule : std::uint8_t {
    sum,          // a + b
    difference,   // a - b
    shift,        // a + number
    turned,       // number - b
    scaled,       // number a
    product,      // a b
    square,       // a^2
    quotient,     // a / b
    reciprocal,   // number / b
    root,         // c^2 = a
    power,        // a^number: a c' = number c a'
    exponential,  // c' = c a'
    absolute,     // a or -a, by the sign of its value
    jump,         // of the values alone, constant in time
    choice,       // b, or 0 where the value of a is
    function      // c' = slope a' + slope b'
  };
  /// One series from at most two others.
  struct Step {
    Rule rule = Rule::function;         ///< The rule.
    Operation operation;                ///< The operation of the node.
    int node;                           ///< The node.
    int c_at;                           ///< Where the coefficients of the result begin,
    int a_at = -1;                      ///< those of the first operand,
    int b_at = -1;                      ///< and those of the second one.
    std::array<int, 2> slopes{-1, -1};  ///< Where those of the slopes of a function begin; -1: none.
    double number = 0.0;                ///< The operand that is constant.
  };

  /// Series up to coefficient `order` of all that these nodes of the graph need.
  /// @param outputs nodes that the first steps give without the rest @param rest further ones
  TaylorSteps(ExpressionGraph graph, const std::vector<int>& outputs, const std::vector<int>& rest,
              int order);

  int stride;               ///< Numbers of a node: its coefficients, and one more.
  int size;                 ///< Numbers of all nodes.
  std::vector<int> places;  ///< Where the coefficients of each node begin; -1: nowhere.
  std::vector<std::pair<int, double>> numbers = {};  ///< Places of constants, and these.
  std::vector<Step> steps = {};                      ///< In the order in which they can be made.
  std::size_t first = 0;                             ///< The first steps that give the first outputs.
};

}  // namespace avi
