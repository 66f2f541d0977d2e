#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// TaylorSteps: the order and the rules in which the Taylor series of the nodes of a formula are computed.

namespace avi {

/// The steps that compute the Taylor series of all nodes that chosen outputs need, for any scalar, and the
/// position of each series in one array of coefficients; see TaylorSeries.
class TaylorSteps {
 public:
  /// How the coefficients c of a node follow from those of its operands a and b. `number` is the operand that
  /// is constant.
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
    jump,         // depends on the values alone; constant in time
    choice,       // b, or 0 where the value of a is 0
    function      // c' = slope a' + slope b'
  };
  /// One series, computed from at most two others.
  struct Step {
    Rule rule = Rule::function;         ///< The rule.
    Operation operation;                ///< The operation of the node.
    int node;                           ///< The node.
    int c_at;                           ///< Where the coefficients of the result begin,
    int a_at = -1;                      ///< those of the first operand,
    int b_at = -1;                      ///< and those of the second one.
    std::array<int, 2> slopes{-1, -1};  ///< Where the coefficients of a function's slopes begin; -1: none.
    double number = 0.0;                ///< The operand that is constant.
  };

  /// Series up to coefficient `order` of all nodes on which the given ones depend.
  /// @param outputs nodes computed by the first steps, without the rest @param rest further nodes
  TaylorSteps(ExpressionGraph graph, const std::vector<int>& outputs, const std::vector<int>& rest,
              int order);

  int stride;               ///< Numbers per node: its coefficients, and one auxiliary number.
  int size;                 ///< Numbers of all nodes together.
  std::vector<int> places;  ///< Where the coefficients of each node begin; -1 where it has none.
  std::vector<std::pair<int, double>> numbers = {};  ///< Positions and values of constants.
  std::vector<Step> steps = {};  ///< All steps, in an order in which they can be computed.
  std::size_t first = 0;         ///< Number of leading steps that give the first outputs.
};

}  // namespace avi
