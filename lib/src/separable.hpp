#pragma once
#include "avi/autodiff/recording.hpp"

#include <algorithm>
#include <vector>

/// @file
/// How positions and momenta meet in a Hamiltonian, read from the graph.

namespace avi::detail {

/// The parts that H is made of.
enum class Parts {
  coupled,   ///< Some force depends on p, or some velocity on q.
  separate,  ///< H = T(p) + V(q).
  nystrom    ///< The same with T of degree 2 at most: velocities are linear in p.
};

/// The parts that H is made of, as it is written: q - q + p depends on q.
/// @param recording of H as a function of (q, p), with its gradient
inline Parts parts_of(const Recording& recording) {
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
  Parts parts = Parts::nystrom;
  for (int i = 0; i < n; ++i) {
    const Kind& velocity = kinds[static_cast<std::size_t>(recording.slope(n + i))];
    if (velocity.of_q || kinds[static_cast<std::size_t>(recording.slope(i))].degree > 0)
      return Parts::coupled;
    if (velocity.degree > 1) parts = Parts::separate;
  }
  return parts;
}

}  // namespace avi::detail
