#pragma once
#include "avi/autodiff/dual_number.hpp"
#include "avi/autodiff/factor.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// Taylor series in time of the nodes of a formula, one coefficient at a time.

namespace avi {

/// Truncated Taylor series c_0, c_1, ... of every node of a graph whose inputs are such series.
///
/// The Taylor coefficients of a solution of \f$z' = f(z)\f$ follow from \f$z_{k+1} = f_k/(k + 1)\f$, where
/// \f$f_k\f$ needs \f$z_0\f$ to \f$z_k\f$ only: run(k) adds coefficient k to every node, from coefficients 0
/// to k of the inputs. Sums and products, and powers with whole exponents, follow Cauchy's rule, quotients
/// and other powers the recurrences of Jorba and Zou (2005, Proposition 1), all other functions \f$k c_k =
/// \sum_j j a_j s_{k-j}\f$ from the series s of their slope (c' = slope(a) a'), which is a formula of the
/// same graph. A product costs k + 1 multiplications at order k, hence O(r^2) in all.
/// @tparam T a number with partial derivatives, DualNumber
template <class T>
class TaylorSeries {
 public:
  /// Series up to coefficient `order` of all that these nodes of the graph need.
  /// @param first nodes that run() gives without the rest @param rest further ones
  TaylorSeries(ExpressionGraph graph, const std::vector<int>& first, const std::vector<int>& rest, int order)
      : stride_(order + 2), graph_(std::move(graph)), size_(graph_.inputs() * stride_) {
    find_slopes(first);
    find_slopes(rest);
    places_.resize(graph_.size(), -1);
    for (int i = 0; i < graph_.inputs(); ++i)
      places_[i] = i * stride_;
    add_steps(parts_of(first));
    first_ = steps_.size();
    add_steps(needed_);
    for (Step& step : steps_)
      for (int k = 0; k < 2; ++k)
        if (const int slope = slopes_[step.node][k]; slope >= 0) step.slopes[k] = series(slope);
    for (const std::vector<int>* outputs : {&first, &rest})
      for (const int node : *outputs)
        (void)series(node);
    coefficients_.assign(size_, T(0.0));
    for (const auto& [at, number] : numbers_)
      coefficients_[at] = T(number);
    graph_ = ExpressionGraph(0);
    link();
  }
  /// A copy with a graph of its own.
  TaylorSeries(const TaylorSeries& other)
      : stride_(other.stride_), graph_(0), size_(other.size_), places_(other.places_), steps_(other.steps_),
        first_(other.first_), coefficients_(other.coefficients_) {
    link();
  }
  TaylorSeries& operator=(const TaylorSeries&) = delete;

  ///@{

  /// The coefficients of input i, up to order + 1.
  [[nodiscard]] T* input(int i) { return coefficients_.data() + i * stride_; }
  [[nodiscard]] const T* input(int i) const { return coefficients_.data() + i * stride_; }
  ///@}
  /// Where output `node` is, for output().
  [[nodiscard]] int place(int node) const { return places_[node]; }
  /// The coefficients of an output, up to the order.
  [[nodiscard]] const T* output(int place) const { return coefficients_.data() + place; }

  /// Coefficient k of all nodes, or of those alone that the first outputs need; coefficients 0 to k - 1 of
  /// all, and k of the inputs, are known.
  void run(int k, bool all) {
    const std::size_t count = all ? steps_.size() : first_;
    const bool done = [&]<int... known>(std::integer_sequence<int, known...>) {
      return ((k == known && (run_order<known>(k, count), true)) || ...);
    }
    (std::make_integer_sequence<int, 8>{});
    if (!done) run_order<-1>(k, count);
  }

 private:
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
  struct Step {
    Rule rule = Rule::function;
    Operation operation;
    int node;
    int c_at, a_at = -1, b_at = -1;  // where the coefficients of the result and of the operands begin
    std::array<int, 2> slopes{-1, -1};
    T* c = nullptr;  // these, in memory
    const T *a = nullptr, *b = nullptr;
    double number = 0.0;
  };

  // ---- the steps of a graph

  static constexpr bool has_slope_rule(Operation operation) {
    return detail::is_function(operation) && operation != Operation::sqrt && operation != Operation::exp &&
           operation != Operation::abs;
  }
  /// The nodes of the slopes of a function; -1 for a constant operand.
  std::array<int, 2> slope_nodes(int node, const ExpressionGraph::Node& what) {
    using detail::Factor;
    const Factor a(graph_, what.a), f(graph_, node);
    if (what.operation == Operation::pow) {  // from f: another power would have a slope of its own, and so on
      const Factor b(graph_, what.b);
      return {graph_.is_constant(what.a) ? -1 : (b * (f / a)).in(graph_),
              graph_.is_constant(what.b) ? -1 : (f * log(a)).in(graph_)};
    }
    switch (what.operation) {
#define AVI_ONE(name, ...)                                                                                   \
  case Operation::name:                                                                                      \
    return {detail::slopes::slope_of_##name(a, f).in(graph_), -1};
#define AVI_TWO(name, ...)                                                                                   \
  case Operation::name: {                                                                                    \
    const Factor b(graph_, what.b);                                                                          \
    return {graph_.is_constant(what.a) ? -1 : detail::slopes::slopes_of_##name<0>(a, b, f).in(graph_),       \
            graph_.is_constant(what.b) ? -1 : detail::slopes::slopes_of_##name<1>(a, b, f).in(graph_)};      \
  }
      AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
    default:
      return {-1, -1};
    }
  }
  /// Marks all nodes that these outputs need, slopes of functions among them, which it adds to the graph.
  void find_slopes(std::vector<int> open) {
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      needed_.resize(graph_.size(), 0);
      slopes_.resize(graph_.size(), {-1, -1});
      if (needed_[node]) continue;
      needed_[node] = 1;
      const ExpressionGraph::Node what = graph_[node];  // a copy: the graph grows
      if (what.operation == Operation::input || what.operation == Operation::constant) continue;
      if (has_slope_rule(what.operation)) slopes_[node] = slope_nodes(node, what);
      for (const int other : {what.a, what.b, slopes_[node][0], slopes_[node][1]})
        if (other >= 0) open.push_back(other);
    }
    needed_.resize(graph_.size(), 0);
  }
  [[nodiscard]] std::vector<char> parts_of(const std::vector<int>& outputs) const {
    std::vector<char> parts(graph_.size(), 0);
    for (const int output : outputs) {
      const std::vector<char> its = graph_.parts(output);
      for (std::size_t i = 0; i < its.size(); ++i)
        parts[i] |= its[i];
    }
    return parts;
  }
  /// Where the coefficients of a node are; those of a constant are made.
  int series(int node) {
    int& place = places_[node];
    if (place < 0) {
      place = allocate();
      numbers_.push_back({place, graph_[node].number});
    }
    return place;
  }
  int allocate() { return std::exchange(size_, size_ + stride_); }
  void add_steps(const std::vector<char>& wanted) {
    for (int node = graph_.inputs(); node < static_cast<int>(wanted.size()); ++node)
      if (wanted[node] && places_[node] < 0 && !graph_.is_constant(node)) {
        if (is_whole_power(node)) {
          places_[node] = add_products(node);
          continue;
        }
        steps_.push_back(step_of(node));
        places_[node] = steps_.back().c_at;
      }
  }
  /// A power that has a series where its base is 0, too; the recurrence of all others divides by the base.
  [[nodiscard]] bool is_whole_power(int node) const {
    if (graph_[node].operation != Operation::power) return false;
    const double exponent = graph_[graph_[node].b].number;
    return exponent >= 1.0 && exponent <= 0x1p30 && exponent == std::round(exponent);
  }
  /// The steps of such a power, products in the order of power(); where the last one's result is.
  int add_products(int node) {
    const auto times = [&](int a, int b) {
      steps_.push_back({.rule = a == b ? Rule::square : Rule::product,
                        .operation = Operation::multiply,
                        .node = node,
                        .c_at = allocate(),
                        .a_at = a,
                        .b_at = b});
      return steps_.back().c_at;
    };
    int square = places_[graph_[node].a], product = -1;
    for (int n = static_cast<int>(graph_[graph_[node].b].number);; square = times(square, square)) {
      if (n % 2) product = product < 0 ? square : times(product, square);
      if ((n /= 2) == 0) return product;
    }
  }
  Step step_of(int node) {
    const auto& [operation, a, b, unused] = graph_[node];
    const bool constant_a = graph_.is_constant(a), constant_b = b >= 0 && graph_.is_constant(b);
    Step step{.operation = operation, .node = node, .c_at = allocate()};
    if (constant_a) step.number = graph_[a].number;
    if (constant_b) step.number = graph_[b].number;
    if (!constant_a) step.a_at = places_[a];
    if (b >= 0 && !constant_b) step.b_at = places_[b];
    switch (operation) {
    case Operation::add:
      step.rule = constant_a || constant_b ? Rule::shift : Rule::sum;
      break;
    case Operation::subtract:
      step.rule = constant_a ? Rule::turned : constant_b ? Rule::shift : Rule::difference;
      if (constant_b) step.number = -step.number;
      break;
    case Operation::multiply:
      step.rule = constant_a || constant_b ? Rule::scaled : a == b ? Rule::square : Rule::product;
      break;
    case Operation::divide:
      step.rule = constant_a ? Rule::reciprocal : constant_b ? Rule::scaled : Rule::quotient;
      if (constant_b) step.number = 1.0 / step.number;
      break;
    case Operation::power:
      step.rule = Rule::power;
      break;
    case Operation::sqrt:
      step.rule = Rule::root;
      break;
    case Operation::exp:
      step.rule = Rule::exponential;
      break;
    case Operation::abs:
      step.rule = Rule::absolute;
      break;
    case Operation::sign:
    case Operation::less:
    case Operation::less_equal:
      step.rule = Rule::jump;
      break;
    case Operation::when:
      step.rule = Rule::choice;
      break;
    default:  // Rule::function
      break;
    }
    if ((step.rule == Rule::shift || step.rule == Rule::scaled) && step.a_at < 0)
      std::swap(step.a_at, step.b_at);
    return step;
  }

  /// Turns places into addresses.
  void link() {
    T* const base = coefficients_.data();
    for (Step& step : steps_) {
      step.c = base + step.c_at;
      step.a = step.a_at >= 0 ? base + step.a_at : nullptr;
      step.b = step.b_at >= 0 ? base + step.b_at : nullptr;
    }
  }

  // ---- their coefficients

  /// Compiled once for each low order: its sums are straight lines. @tparam known the order, or -1
  template <int known>
  [[gnu::noinline]] void run_order(int k, std::size_t count) {
    for (const Step *step = steps_.data(), *end = step + count; step != end; ++step)
      compute<known>(*step, k);
  }
  template <int known>
  [[gnu::always_inline]] void compute(const Step& step, int order) {
    const int k = known >= 0 ? known : order;
    using std::exp, std::sqrt;
    T* const c = step.c;
    const T *const a = step.a, *const b = step.b;
    T& auxiliary = c[stride_ - 1];  // what every coefficient is multiplied with
    switch (step.rule) {
    case Rule::sum:
      c[k] = a[k] + b[k];
      break;
    case Rule::difference:
      c[k] = a[k] - b[k];
      break;
    case Rule::shift:
      c[k] = k == 0 ? a[0] + step.number : a[k];
      break;
    case Rule::turned:
      c[k] = k == 0 ? step.number - b[0] : -b[k];
      break;
    case Rule::scaled:
      c[k] = step.number * a[k];
      break;
    case Rule::product:
      c[k] = convolution(a, b, k, 0, k);
      break;
    case Rule::square:
      c[k] = convolution_square(a, k);
      break;
    case Rule::quotient:
      if (k == 0) auxiliary = 1.0 / b[0];
      c[k] = (a[k] - convolution(b, c, k, 1, k)) * auxiliary;
      break;
    case Rule::reciprocal:
      if (k == 0) auxiliary = 1.0 / b[0];
      c[k] = (T(k == 0 ? step.number : 0.0) - convolution(b, c, k, 1, k)) * auxiliary;
      break;
    case Rule::root:
      if (k == 0) {
        c[0] = sqrt(a[0]);
        auxiliary = 0.5 / c[0];
      } else {
        c[k] = (a[k] - convolution(c, c, k, 1, k - 1)) * auxiliary;
      }
      break;
    case Rule::power:
      if (k == 0) {
        c[0] = avi::power(a[0], step.number);
        auxiliary = 1.0 / a[0];
      } else {
        c[k] = convolution_weighted(a, c, k, step.number + 1.0, -k) * auxiliary;
      }
      break;
    case Rule::exponential:
      c[k] = k == 0 ? exp(a[0]) : convolution_weighted(a, c, k, 1.0, 0.0);
      break;
    case Rule::absolute:
      c[k] = std::signbit(value_of(a[0])) ? -a[k] : a[k];
      break;
    case Rule::choice:
      if (!(value_of(a[0]) > 0.0))
        c[k] = T(0.0);
      else
        c[k] = b ? b[k] : T(k == 0 ? step.number : 0.0);
      break;
    case Rule::jump:
      c[k] = k == 0 ? at_start(step) : T(0.0);
      break;
    case Rule::function:
      c[k] = k == 0 ? at_start(step) : by_slopes(step, k);
      break;
    }
  }
  [[gnu::noinline]] static T at_start(const Step& step) {
    const T a = step.a ? step.a[0] : T(step.number), b = step.b ? step.b[0] : T(step.number);
    T result(0.0);
    detail::with_operation(step.operation, [&]<Operation known>() { result = detail::apply<known>(a, b); });
    return result;
  }
  [[gnu::noinline]] T by_slopes(const Step& step, int k) const {
    T sum(0.0);
    for (const auto& [operand, slope] : {std::pair{step.a, step.slopes[0]}, {step.b, step.slopes[1]}})
      if (slope >= 0) sum = sum + convolution_weighted(operand, output(slope), k, 1.0, 0.0);
    return sum;
  }

  // Inlined where k is known, which -O2 alone would not do: the sums become straight lines, twice as fast.

  /// Sum over j = from..to of a_j b_(k-j).
  [[gnu::always_inline]] static T convolution(const T* a, const T* b, int k, int from, int to) {
    ProductSum<T> s;
    for (int j = from; j <= to; ++j)
      s.add(a[j], b[k - j]);
    return s.result();
  }
  /// Coefficient k of a^2: each pair once, doubled.
  [[gnu::always_inline]] static T convolution_square(const T* a, int k) {
    ProductSum<T> s;
    for (int j = 0; 2 * j < k; ++j)
      s.add(a[j], a[k - j], 2.0);
    if (k % 2 == 0) s.add(a[k / 2], a[k / 2]);
    return s.result();
  }
  /// Sum over j = 1..k of (slope j + shift) a_j b_(k-j) / k.
  [[gnu::always_inline]] static T convolution_weighted(const T* a, const T* b, int k, double slope,
                                                       double shift) {
    ProductSum<T> s;
    for (int j = 1; j <= k; ++j)
      s.add(a[j], b[k - j], slope * j + shift);
    return (1.0 / k) * s.result();
  }

  int stride_;             // numbers of a node: its coefficients, and one more
  ExpressionGraph graph_;  // while steps are made
  int size_;               // numbers of all nodes
  std::vector<char> needed_;
  std::vector<std::array<int, 2>> slopes_;
  std::vector<int> places_;
  std::vector<std::pair<int, double>> numbers_;  // series of constants
  std::vector<Step> steps_;
  std::size_t first_ = 0;
  std::vector<T> coefficients_;
};

}  // namespace avi
