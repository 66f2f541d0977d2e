#pragma once
#include "avi/autodiff/recorded_call.hpp"
#include "avi/core/power.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

/// @file
/// A recorded function of (q, p) that is called like any other.

namespace avi {

/// A recorded function f(q, p). All of them have this one type, so that code which uses them is compiled
/// once. It is called with vectors of n entries of any scalar: double, Pack, Partials, Jet, Recorded. Copies
/// share the list of operations. Each thread keeps its working memory from call to call.
class PhaseFunction {
 public:
  /// The value of `node` in a graph whose inputs are (q, p).
  PhaseFunction(const ExpressionGraph& graph, int node)
      : steps_(compact(graph, node)), n_(graph.inputs() / 2) {}

  [[nodiscard]] Eigen::Index size() const { return n_; }  ///< n.
  /// What a call costs for so many lanes, in additions of all of them: a division or a root is about 2, a
  /// function that goes lane by lane 4 for each (measured with 4 and 8 lanes).
  [[nodiscard]] double work(int lanes) const {
    double sum = 0.0;
    for (const Step& step : *steps_)
      sum += detail::work(step.operation, step.number).at(lanes);
    return sum;
  }

  /// f at a point of phase space.
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using S = typename Q::Scalar;
    thread_local std::vector<S> values;
    const std::vector<Step>& steps = *steps_;
    if (values.size() < steps.size()) values.resize(steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Step& step = steps[i];
      if (step.operation == Operation::input)
        values[i] = step.a < n_ ? q[step.a] : p[step.a - n_];
      else if (step.operation == Operation::constant)
        values[i] = S(step.number);
      else if (step.operation == Operation::power)
        values[i] = power(values[step.a], step.number);
      else
        detail::with_operation(step.operation, [&]<Operation known>() {
          if constexpr (known != Operation::power)
            values[i] = detail::apply<known>(values[step.a], values[step.b < 0 ? step.a : step.b]);
        });
    }
    return S(values[steps.size() - 1]);
  }

 private:
  using Step = ExpressionGraph::Node;

  static std::shared_ptr<const std::vector<Step>> compact(const ExpressionGraph& graph, int node) {
    const std::vector<char> part = graph.parts(node);
    std::vector<int> place(part.size());
    auto steps = std::make_shared<std::vector<Step>>();
    for (int i = 0; i <= node; ++i) {
      if (!part[i]) continue;
      Step step = graph[i];
      if (step.operation == Operation::power) {
        step.number = graph[step.b].number;
        step.b = -1;
      }
      if (has_operands(step)) {
        step.a = place[step.a];
        if (step.b >= 0) step.b = place[step.b];
      }
      place[i] = static_cast<int>(steps->size());
      steps->push_back(step);
    }
    return steps;
  }

  static bool has_operands(const Step& step) {
    return step.operation != Operation::input && step.operation != Operation::constant;
  }

  std::shared_ptr<const std::vector<Step>> steps_;
  Eigen::Index n_;
};

/// The formula of a callable f(q, p), called once with recording vectors of n entries.
/// @param size n, where it is avi::dynamic
template <int n = dynamic, class F>
PhaseFunction phase_function(const F& f, Eigen::Index size = n) {
  const int count = static_cast<int>(size);
  ExpressionGraph graph(2 * count);
  const Recorded value =
      detail::recorded_call(f, recorded_inputs<n>(graph, 0, count), recorded_inputs<n>(graph, count, count));
  return {graph, value.node_in(graph)};
}

namespace detail {

/// H as a formula and the start of an orbit in vectors whose size is known at run time: what is found out
/// about the orbit is then compiled once for all H.
struct Orbit {
  PhaseFunction energy;  ///< H.
  State<dynamic> start;  ///< With finite H.

  /// Records H. @throws std::invalid_argument where q and p are of different size or empty, or H is not
  /// finite at the start.
  template <class H, int n>
  Orbit(const H& hamiltonian, const State<n>& from)
      : energy((require_dimension(from), phase_function<n>(hamiltonian, from.q.size()))), start{.q = from.q,
                                                                                                .p = from.p,
                                                                                                .t = from.t} {
    check();
  }

  /// Of H that is recorded already. @throws std::invalid_argument where H is not finite at the start.
  Orbit(PhaseFunction hamiltonian, State<dynamic> from)
      : energy(std::move(hamiltonian)), start(std::move(from)) {
    check();
  }

  [[nodiscard]] double energy_at_start() const { return energy(start.q, start.p); }  ///< H_0.

 private:
  void check() const {
    if (!start.finite() || !std::isfinite(energy_at_start()))
      throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
  }
};

}  // namespace detail

}  // namespace avi
