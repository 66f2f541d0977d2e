#pragma once
#include "avi/autodiff/recording.hpp"

#include <algorithm>
#include <vector>

/// @file
/// Hamiltonians that an explicit splitting is for, read from the graph.

namespace avi::detail {

/// H = T(p) + V(q) with T of degree 2 at most in p: no force depends on p, no velocity on q, and velocities
/// are linear in p. What only looks otherwise, as q - q + p, counts as it looks.
/// @param recording of H as a function of (q, p), with its gradient
inline bool is_nystrom(const Recording& recording) {
  const ExpressionGraph& graph = recording.graph();
  const int n = graph.inputs() / 2;
  struct Kind {
    bool of_q = false;
    int degree = 0;  // in p; 2 stands for any that is not 0 or 1
  };
  std::vector<Kind> kinds(static_cast<std::size_t>(graph.size()));
  for (int i = 0; i < graph.size(); ++i) {
    const auto& [operation, a, b, number] = graph[i];
    Kind& kind = kinds[static_cast<std::size_t>(i)];
    if (operation == Operation::input) {
      kind = {.of_q = a < n, .degree = a < n ? 0 : 1};
      continue;
    }
    if (operation == Operation::constant) continue;
    const Kind& first = kinds[static_cast<std::size_t>(a)];
    const Kind second = b < 0 ? Kind{} : kinds[static_cast<std::size_t>(b)];
    kind.of_q = first.of_q || second.of_q;
    switch (operation) {
    case Operation::add:
    case Operation::subtract:
      kind.degree = std::max(first.degree, second.degree);
      break;
    case Operation::multiply:
      kind.degree = std::min(2, first.degree + second.degree);
      break;
    case Operation::divide:
      kind.degree = second.degree > 0 ? 2 : first.degree;
      break;
    default:
      kind.degree = first.degree + second.degree > 0 ? 2 : 0;
    }
  }
  for (int i = 0; i < n; ++i) {
    if (kinds[static_cast<std::size_t>(recording.slope(i))].degree > 0) return false;
    const Kind& velocity = kinds[static_cast<std::size_t>(recording.slope(n + i))];
    if (velocity.of_q || velocity.degree > 1) return false;
  }
  return true;
}

}  // namespace avi::detail
