#pragma once
#include "avi/autodiff/recorded_call.hpp"

#include <memory>
#include <utility>
#include <vector>

/// @file
/// Formula: a function that is called once to record its operations, and then evaluated and differentiated
/// from the record.

namespace avi {

/// A real function of N numbers, stored as the graph of its operations. It is immutable, so copies share the
/// graph. All formulas have this one type, so code that uses them is compiled once.
///
/// A formula may have k parameters beside its N arguments. They are the last inputs of the graph. No
/// derivatives are taken with respect to them, and with() changes their values without recording again.
///
/// The function is called once, with a scalar that records the operations applied to it; see Recording for
/// what it may do. Evaluation interprets the graph; for many evaluations, the Program of
/// Recording(formula).value_and_gradient() is faster.
class Formula {
 public:
  ///@{

  /// The formula whose value is a node of a graph. Operations that it does not need are dropped.
  /// @param parameters values of the last inputs of the graph; if empty, all inputs are arguments
  /// @throws std::invalid_argument for a node that is not in the graph, or more parameters than inputs.
  Formula(ExpressionGraph&& graph, int node, std::vector<double> parameters = {});
  // The graph is copied here, in the body of the call, because evaluating the argument `node` may still add
  // nodes to it.
  Formula(const ExpressionGraph& graph, int node, std::vector<double> parameters = {})
      : Formula(ExpressionGraph(graph), node, std::move(parameters)) {}
  ///@}

  ///@{

  /// f(x) or f(x, c), for a vector x of n entries and parameters c.
  /// @throws std::invalid_argument for n < 1.
  template <class F>
  static Formula of_point(const F& f, Eigen::Index n) {
    return record(n, {}, [&](ExpressionGraph& graph, int count) {
      return detail::recorded_call(f, recorded_inputs(graph, 0, count));
    });
  }
  template <class F>
  static Formula of_point(const F& f, Eigen::Index n, std::vector<double> c) {
    return record(n, std::move(c), [&](ExpressionGraph& graph, int count) {
      return detail::recorded_call(f, recorded_inputs(graph, 0, count), parameters_in(graph, count));
    });
  }
  ///@}
  ///@{

  /// H(q, p) or H(q, p, c), with n degrees of freedom and parameters c. The arguments are (q, p), in this
  /// order.
  /// @tparam d n, where it is known at compile time @throws std::invalid_argument for n < 1, or another d.
  template <int d = dynamic, class F>
  static Formula of_phase(const F& f, Eigen::Index n = d) {
    return record(2 * degrees(n), {}, [&](ExpressionGraph& graph, int count) {
      return detail::recorded_call(f, recorded_inputs<d>(graph, 0, n),
                                   recorded_inputs<d>(graph, count / 2, n));
    });
  }
  template <int d = dynamic, class F>
  static Formula of_phase(const F& f, Eigen::Index n, std::vector<double> c) {
    return record(2 * degrees(n), std::move(c), [&](ExpressionGraph& graph, int count) {
      return detail::recorded_call(f, recorded_inputs<d>(graph, 0, n),
                                   recorded_inputs<d>(graph, count / 2, n), parameters_in(graph, count));
    });
  }
  ///@}
  ///@{

  /// H(q, t, p) or H(q, t, p, c), with n degrees of freedom and parameters c. The arguments are (q, p, t),
  /// with time last.
  /// @tparam d n, where it is known at compile time @throws std::invalid_argument for n < 1, or another d.
  template <int d = dynamic, class F>
  static Formula of_phase_and_time(const F& f, Eigen::Index n = d) {
    return record(2 * degrees(n) + 1, {}, [&](ExpressionGraph& graph, int count) {
      return detail::recorded_call(f, recorded_inputs<d>(graph, 0, n), Recorded(graph, count - 1),
                                   recorded_inputs<d>(graph, count / 2, n));
    });
  }
  template <int d = dynamic, class F>
  static Formula of_phase_and_time(const F& f, Eigen::Index n, std::vector<double> c) {
    return record(2 * degrees(n) + 1, std::move(c), [&](ExpressionGraph& graph, int count) {
      return detail::recorded_call(f, recorded_inputs<d>(graph, 0, n), Recorded(graph, count - 1),
                                   recorded_inputs<d>(graph, count / 2, n), parameters_in(graph, count));
    });
  }
  ///@}

  [[nodiscard]] const ExpressionGraph& graph() const { return shared_->graph; }  ///< The graph of operations.
  [[nodiscard]] int node() const { return shared_->node; }  ///< Node of graph() that holds the value.
  /// N, the number of arguments: the inputs of the graph without the parameters.
  [[nodiscard]] int inputs() const { return graph().inputs() - static_cast<int>(parameters_.size()); }
  /// Values of the parameters.
  [[nodiscard]] const std::vector<double>& parameters() const { return parameters_; }

  /// The same formula with other values of its parameters; the graph is shared.
  /// @throws std::invalid_argument for another number of parameters.
  [[nodiscard]] Formula with(std::vector<double> parameters) const;
  /// The same formula as a function of its arguments alone, with the parameters made constants. A formula
  /// without parameters is returned as it is.
  [[nodiscard]] Formula with_constants() const;

  /// f at x = (x_1 ... x_N). @throws std::invalid_argument for a vector of another size.
  template <class = void>  // a template, so that it is compiled only where it is called
  [[nodiscard]] double value(const VectorX& x) const {
    return at(x);
  }
  /// The gradient at x, by reverse accumulation. The first call derives the formula of the gradient.
  /// @throws std::invalid_argument for a vector of another size.
  template <class = void>
  [[nodiscard]] VectorX gradient(const VectorX& x) const {
    check_entries(x.size());
    VectorX slopes(x.size());
    gradient(x.data(), slopes.data());
    return slopes;
  }

  ///@{

  /// The value for vectors of any scalar: double, Pack, Partials, Recorded. Each thread keeps its working
  /// memory between calls. @throws std::invalid_argument unless there are as many entries as arguments, and p
  /// has as many as q.
  template <class Q>
  typename Q::Scalar at(const Q& x) const {
    return evaluate<typename Q::Scalar>(x.size(), [&](auto& values) { append(values, x); });
  }
  template <class Q, class P>
  typename Q::Scalar at(const Q& q, const P& p) const {
    check_halves(q.size(), p.size());
    return evaluate<typename Q::Scalar>(q.size() + p.size(), [&](auto& values) {
      append(values, q);
      append(values, p);
    });
  }
  template <class Q, class T, class P>
  typename Q::Scalar at(const Q& q, const T& t, const P& p) const {
    check_halves(q.size(), p.size());
    return evaluate<typename Q::Scalar>(q.size() + 1 + p.size(), [&](auto& values) {
      append(values, q);
      append(values, p);
      values.push_back(t);
    });
  }
  ///@}
  /// The value at (q, p), so that the formula can serve as a Hamiltonian or a monitor. There is no such call
  /// for a monitor g(q) or g(q, t, p).
  template <class Q, class P>
  typename Q::Scalar operator()(const Q& q, const P& p) const {
    return at(q, p);
  }

 private:
  struct Gradient;

  // Pointers, not Eigen vectors, cross into the compiled library: it may be compiled for another instruction
  // set.
  void gradient(const double* x, double* slopes) const;
  static Eigen::Index degrees(Eigen::Index n) {
    require(n >= 1, "Number of degrees of freedom to record", n, "at least 1");
    return n;
  }
  void check_entries(Eigen::Index entries) const {
    require(entries == inputs(), "Number of arguments of a formula", entries, "", inputs());
  }
  static void check_halves(Eigen::Index q, Eigen::Index p) {
    require(p == q, "Number of momenta of a formula", p, "that of the positions, ", q);
  }
  static RecordedVector<> parameters_in(ExpressionGraph& graph, int first) {
    return recorded_inputs(graph, first, graph.inputs() - first);
  }
  template <class Call>
  static Formula record(Eigen::Index inputs, std::vector<double> parameters, const Call& call) {
    require(inputs >= 1, "Number of arguments to record", inputs, "at least 1");
    const int count = static_cast<int>(inputs);
    ExpressionGraph graph(count + static_cast<int>(parameters.size()));
    const Recorded result = call(graph, count);
    const int node = result.node_in(graph);
    return {std::move(graph), node, std::move(parameters)};
  }

  template <class Values, class V>
  static void append(Values& values, const V& x) {
    for (Eigen::Index i = 0; i < x.size(); ++i)
      values.push_back(x[i]);
  }
  template <class S, class Fill>
  S evaluate(Eigen::Index entries, const Fill& fill) const {
    check_entries(entries);
    thread_local std::vector<S> values;
    values.clear();
    fill(values);
    for (const double c : parameters_)
      values.push_back(S(c));
    return detail::evaluate(graph(), node(), values);
  }

  struct Shared {
    ExpressionGraph graph;
    int node;
    std::shared_ptr<Gradient> gradient;
  };
  std::shared_ptr<const Shared> shared_;
  std::vector<double> parameters_;
};

}  // namespace avi
