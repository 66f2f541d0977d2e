#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <cstddef>
#include <vector>

/// @file
/// The divisors of a Hamiltonian, and degrees, powers and bounds of the nodes of its graph.

namespace avi::detail {

/// The functions of coordinates alone that H, a node of a graph of (q, p), divides by, or takes a negative
/// power or the logarithm of. Where that is a product of powers, its factors are taken, as H is infinite
/// where one of them is zero. @param on see dependences() @param most the search ends when there are more
std::vector<int> divisors(const ExpressionGraph& graph, int energy, const std::vector<unsigned char>& on,
                          std::size_t most);

/// Returns true for a node that is singular where its base is 0: a root, a logarithm or a non-integer power.
bool is_singular_at_zero(const ExpressionGraph& graph, int node);

/// Sets the power of a quantity in each node from `from` on, by the rules for products and powers.
/// @param otherwise gives the power for other operations, from the powers in their arguments
void follow_powers(const ExpressionGraph& graph, std::vector<double>& powers, std::size_t from,
                   double (*otherwise)(Operation, double, double));

/// The power of a node in another one, as it vanishes. Where the other is their quotient with what vanishes
/// as fast, it is 0.
double power_in(const ExpressionGraph& graph, int node, int base);

/// The degrees of the nodes up to this one in their arguments, at least 1; in a sum with other terms,
/// constants count as degree 0.
std::vector<double> degrees_of(const ExpressionGraph& graph, int node);

/// Lower bounds of the nodes up to this one, as far as the formula shows them; minus infinity elsewhere.
std::vector<double> lower_bounds(const ExpressionGraph& graph, int node);

}  // namespace avi::detail
