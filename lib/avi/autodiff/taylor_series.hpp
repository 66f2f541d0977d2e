#pragma once
#include "avi/autodiff/dual_number.hpp"
#include "avi/autodiff/taylor_steps.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

/// @file
/// TaylorSeries: Taylor series in time of the nodes of a formula, computed one coefficient at a time.

namespace avi {

/// Truncated Taylor series c_0, c_1, ... of every node of a graph, from the series of its inputs.
///
/// The Taylor coefficients of a solution of \f$z' = f(z)\f$ follow from \f$z_{k+1} = f_k/(k + 1)\f$, where
/// \f$f_k\f$ depends only on \f$z_0\f$ to \f$z_k\f$. run(k) therefore adds coefficient k to every node, from
/// coefficients 0 to k of the inputs. Products and whole powers follow Cauchy's product rule, quotients
/// and other powers the recurrences of Jorba and Zou (2005, Proposition 1). For all other functions c of a,
/// \f$k c_k = \sum_j j a_j s_{k-j}\f$ with the series s of the slope (c' = slope(a) a'), which is itself a
/// formula of the same graph. A product costs k + 1 multiplications at order k, hence O(r^2) in all.
/// @tparam T a number with partial derivatives, DualNumber
template <class T>
class TaylorSeries {
 public:
  /// Series up to coefficient `order` of all nodes on which the given ones depend.
  /// @param first nodes that run() can compute without the rest @param rest further nodes
  TaylorSeries(ExpressionGraph graph, const std::vector<int>& first, const std::vector<int>& rest, int order)
      : made_(std::make_shared<const TaylorSteps>(std::move(graph), first, rest, order)),
        coefficients_(made_->size, T(0.0)) {
    for (const auto& [at, number] : made_->numbers)
      coefficients_[at] = T(number);
    link();
  }
  /// A copy with coefficients of its own.
  TaylorSeries(const TaylorSeries& other) : made_(other.made_), coefficients_(other.coefficients_) { link(); }
  TaylorSeries& operator=(const TaylorSeries&) = delete;

  ///@{

  /// The coefficients of input i, up to order + 1; the caller sets them.
  [[nodiscard]] T* input(int i) { return coefficients_.data() + i * stride_; }
  [[nodiscard]] const T* input(int i) const { return coefficients_.data() + i * stride_; }
  ///@}
  /// The position of output `node` in the array of coefficients, for output().
  [[nodiscard]] int place(int node) const { return made_->places[node]; }
  /// The coefficients of an output, up to `order`.
  [[nodiscard]] const T* output(int place) const { return coefficients_.data() + place; }

  /// Computes coefficient k of all nodes, or only of those that the first outputs need. Coefficients 0 to k -
  /// 1 of all nodes, and k of the inputs, must be known.
  void run(int k, bool all) {
    const std::size_t count = all ? steps_.size() : made_->first;
    const bool done = [&]<int... known>(std::integer_sequence<int, known...>) {
      return ((k == known && (run_order<known>(k, count), true)) || ...);
    }
    (std::make_integer_sequence<int, 8>{});
    if (!done) run_order<-1>(k, count);
  }

 private:
  using Rule = TaylorSteps::Rule;
  struct Step : TaylorSteps::Step {
    T* c;  // coefficients of the result
    const T *a, *b;
  };

  /// Converts the positions of all series to addresses.
  void link() {
    T* const base = coefficients_.data();
    for (const TaylorSteps::Step& step : made_->steps)
      steps_.push_back({step, base + step.c_at, step.a_at >= 0 ? base + step.a_at : nullptr,
                        step.b_at >= 0 ? base + step.b_at : nullptr});
    stride_ = made_->stride;
  }

  /// Compiled separately for each low order, where the sums become straight-line code. @tparam known the
  /// order, or -1
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
    T& auxiliary = c[stride_ - 1];  // factor common to all coefficients
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

  // Forced inlining: -O2 alone would not inline where k is known, although the sums then become straight-line
  // code and twice as fast.

  /// Sum over j = from..to of a_j b_(k-j).
  [[gnu::always_inline]] static T convolution(const T* a, const T* b, int k, int from, int to) {
    ProductSum<T> s;
    for (int j = from; j <= to; ++j)
      s.add(a[j], b[k - j]);
    return s.result();
  }
  /// Coefficient k of a^2: each pair is multiplied once and doubled.
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

  std::shared_ptr<const TaylorSteps> made_;  // copies share them
  std::vector<T> coefficients_;
  std::vector<Step> steps_;
  int stride_ = 0;
};

}  // namespace avi
