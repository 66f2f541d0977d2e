#pragma once
#include "avi/autodiff/recorded_call.hpp"

#include <memory>
#include <utility>
#include <vector>

/// @file
/// A function that is recorded once and evaluated, differentiated and integrated without being called again.

namespace avi {

/// A real function of N numbers as the graph of its operations: immutable, so copies share it. All formulas
/// have this one type, and code that uses them is compiled once.
///
/// A formula may have k parameters beside its N arguments. They are the last inputs of the graph, no
/// derivatives are taken by them, and with() gives them other values without recording anything again.
///
/// The function that it is made from is called once, with a scalar that writes down what is done to it
/// (Recording says what it may do). Evaluations at a point interpret the graph; for many of them take
/// Recording(formula).value_and_gradient(), a Program.
class Formula {
 public:
  ///@{

  /// The formula of a node of a graph; operations that it does not need are left behind.
  /// @param parameters values of the last inputs of the graph; none: all inputs are arguments
  /// @throws std::invalid_argument for a node that the graph has not, or more parameters than inputs.
  Formula(ExpressionGraph&& graph, int node, std::vector<double> parameters = {});
  // A copy is made only here, as the argument for `node` may add that to the graph.
  Formula(const ExpressionGraph& graph, int node, std::vector<double> parameters = {})
      : Formula(ExpressionGraph(graph), node, std::move(parameters)) {}
  ///@}

  ///@{

  /// f(x), or f(x, c), of a vector of n entries, and of parameters c.
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

  /// H(q, p), or H(q, p, c), with n degrees of freedom; arguments are (q, p).
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

  /// H(q, t, p), or H(q, t, p, c), with n degrees of freedom; arguments are (q, p, t), time last.
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

  [[nodiscard]] const ExpressionGraph& graph() const { return shared_->graph; }  ///< Its operations.
  [[nodiscard]] int node() const { return shared_->node; }                       ///< Its value in graph().
  /// N, the number of arguments: inputs of the graph but for the parameters.
  [[nodiscard]] int inputs() const { return graph().inputs() - static_cast<int>(parameters_.size()); }
  [[nodiscard]] const std::vector<double>& parameters() const { return parameters_; }  ///< Their values.

  /// The same formula at other values of its parameters; the graph is shared.
  /// @throws std::invalid_argument for another number of them.
  [[nodiscard]] Formula with(std::vector<double> parameters) const;
  /// The formula of its arguments alone: parameters become constants. Without any it is the formula itself.
  [[nodiscard]] Formula with_constants() const;

  /// f at x = (x_1 ... x_N). @throws std::invalid_argument for a vector of another size.
  template <class = void>  // so that who does not call it need not compile it
  [[nodiscard]] double value(const VectorX& x) const {
    return at(x);
  }
  /// The gradient there, by reverse accumulation; the first call finds its formula.
  /// @throws std::invalid_argument for a vector of another size.
  template <class = void>
  [[nodiscard]] VectorX gradient(const VectorX& x) const {
    check_entries(x.size());
    VectorX slopes(x.size());
    gradient(x.data(), slopes.data());
    return slopes;
  }

  ///@{

  /// The value at vectors of any scalar: double, Pack, Partials, Recorded. Each thread keeps its working
  /// memory from call to call. @throws std::invalid_argument unless there are as many entries as arguments,
  /// and as many in p as in q.
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
  /// As a Hamiltonian or a monitor is called; a formula of a point, or of time, is no monitor g(q) or g(q, t,
  /// p).
  template <class Q, class P>
  typename Q::Scalar operator()(const Q& q, const P& p) const {
    return at(q, p);
  }

 private:
  struct Gradient;

  // Vectors of another library are not passed on: the library may be compiled for another processor.
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
