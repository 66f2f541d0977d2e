#pragma once
#include "avi/autodiff/recording.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

/// @file
/// How positions and momenta are coupled in a Hamiltonian, read from the graph.

namespace avi::detail {

/// The kinds of arguments that a node depends on: all coordinates but the last one; the last one, which may
/// be time; momenta.
enum Dependence : unsigned char { on_q = 1, on_last = 2, on_p = 4 };

/// Returns what each node of a graph of (q, p) up to this one depends on, as its formula is written.
inline std::vector<unsigned char> dependences(const ExpressionGraph& graph, int node) {
  const int n = graph.inputs() / 2;
  std::vector<unsigned char> on(static_cast<std::size_t>(node) + 1, 0);
  for (int i = 0; i <= node; ++i)
    if (const ExpressionGraph::Node& what = graph[i]; what.operation == Operation::input)
      on[i] = what.a >= n ? on_p : what.a == n - 1 ? on_last : on_q;
    else
      for (const int operand : {what.a, what.b})
        if (operand >= 0) on[i] |= on[operand];
  return on;
}

/// The structure of H, by the parts of which it is a sum.
enum class Parts {
  coupled,   ///< Some force depends on p, or some velocity on q.
  separate,  ///< H = T(p) + V(q).
  nystrom    ///< The same with T of degree 2 at most: velocities are linear in p.
};

/// The structure of H, as its formula is written: q - q + p depends on q. @param recording recording of H as
/// a function of (q, p), with its gradient
inline Parts parts_of(const Recording& recording) {
  const ExpressionGraph& graph = recording.graph();
  const int n = graph.inputs() / 2;
  const std::vector<unsigned char> on = dependences(graph, graph.size() - 1);
  std::vector<int> degree(on.size(), 0);  // degree in p; 2 stands for all but 0 and 1
  for (int i = 0; i < graph.size(); ++i) {
    const auto& [operation, a, b, number] = graph[i];
    if (operation == Operation::constant) continue;
    const int first = operation == Operation::input ? a >= n : degree[a], second = b < 0 ? 0 : degree[b];
    switch (operation) {
    case Operation::input:
    case Operation::add:
    case Operation::subtract:
      degree[i] = std::max(first, second);
      break;
    case Operation::multiply:
      degree[i] = std::min(2, first + second);
      break;
    case Operation::divide:
      degree[i] = second > 0 ? 2 : first;
      break;
    default:
      degree[i] = first + second > 0 ? 2 : 0;
    }
  }
  Parts parts = Parts::nystrom;
  for (int i = 0; i < n; ++i) {
    const int velocity = recording.slope(n + i);
    if ((on[velocity] & (on_q | on_last)) != 0 || degree[recording.slope(i)] > 0) return Parts::coupled;
    if (degree[velocity] > 1) parts = Parts::separate;
  }
  return parts;
}

}  // namespace avi::detail
