#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <cstddef>
#include <vector>

/// @file
/// What a Hamiltonian divides by.

namespace avi::detail {

/// The functions of coordinates alone that H, a node of a graph of (q, p), divides by, or takes a negative
/// power or the logarithm of. Where that is a product of powers, its factors are taken, as H is infinite
/// where one of them is zero. @param on see dependences() @param most the search ends when there are more
std::vector<int> divisors(const ExpressionGraph& graph, int energy, const std::vector<unsigned char>& on,
                          std::size_t most);

}  // namespace avi::detail
