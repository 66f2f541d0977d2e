#pragma once
#include "avi/collocation/gauss_rule.hpp"
#include "avi/collocation/stage_field.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <type_traits>
#include <utility>

/// @file
/// The equations for the stages of a collocation step, and the sweeps that solve them.

namespace avi {

/// A w x w matrix, stored by columns, each of which is a Pack.
template <int w>
class alignas(64) LaneMatrix {
 public:
  LaneMatrix() { columns_.fill(Pack<w>(0.0)); }  ///< The zero matrix.
  /// Sets the entry in row i and column j.
  void set(int i, int j, double value) { columns_[j].set(i, value); }
  void set(int j, const Pack<w>& column) { columns_[j] = column; }  ///< Sets column j.

  /// Matrix times vector. The products are added as a tree, in the same order on every machine.
  [[gnu::always_inline]] Pack<w> operator*(const Pack<w>& x) const { return times(x, Pack<w>(0.0)); }
  /// Matrix times vector, plus another vector. That one is added first, since it is available before the
  /// products.
  [[gnu::always_inline]] Pack<w> times(const Pack<w>& x, const Pack<w>& first) const {
    Pack<w> term[w];
    for (int j = 0; j < w; ++j)
      term[j] = columns_[j] * Pack<w>(x[j]);
    term[0] += first;
    for (int half = w / 2; half > 0; half /= 2)
      for (int i = 0; i < half; ++i)
        term[i] += term[i + half];
    return term[0];
  }

 private:
  std::array<Pack<w>, w> columns_;
};

/// The equations for the stages of a rule of at most w stages, \f[ z_i = z_0 + \sum_j \mu_{ij} L_j, \qquad
/// L_j = h b_j f(z_j). \f] The step ends at \f$z_0 + \sum_j L_j\f$. Lanes beyond the last stage repeat that
/// stage with weight zero, so that the formula is never evaluated at an arbitrary point.
///
/// A sweep computes all forces and from them new momenta, then with these all velocities and new positions.
/// It is a chain of operations, each of which waits for the one before, so the processor has room for a
/// second chain. A step can therefore be swept together with the next one, which begins at the end of this
/// step as known so far.
template <int n, int w>
class alignas(64) StageEquations {
 public:
  using Scalar = Pack<w>;          ///< One number for each stage.
  using Vec = Vector<Scalar, n>;   ///< One vector for each stage.
  using Step = StageValues<n, w>;  ///< The unknowns of the equations.
  using Field = StageField<n, w>;  ///< The field f.
  /// Limit for the extrapolation of the polynomial of another step, as a multiple of the largest increment at
  /// a stage of that step; about ten times the distance it moved. With 10 or 20, some of twenty test problems
  /// take a third longer; without a limit, one takes eight times as long.
  static constexpr double far = 50.0;

  /// For this field and this rule.
  StageEquations(std::unique_ptr<Field> field, const GaussRule& rule)
      : field_(std::move(field)), rule_(rule) {
    for (int j = 0; j < rule.stages(); ++j)
      for (int i = 0; i < w; ++i)
        mu_.set(i, j, rule.mu(std::min(i, rule.stages() - 1), j));
  }

  [[nodiscard]] Field& field() { return *field_.its; }              ///< The field f.
  [[nodiscard]] const Field& field() const { return *field_.its; }  ///< The field f.
  [[nodiscard]] const GaussRule& rule() const { return rule_; }     ///< Nodes, weights and \f$\mu_{ij}\f$.

  /// Sets the size of the steps that follow to h.
  void set_step(double h) {
    for (int j = 0; j < rule_.stages(); ++j)
      weight_.set(j, h * rule_.weight(j));
  }

  /// First guess of the stages without a previous step: the start itself.
  static void begin(Step& step) {
    for (Eigen::Index i = 0; i < step.q.size(); ++i) {
      step.q[i] = Scalar(step.start.state.q[i]);
      step.p[i] = Scalar(step.start.state.p[i]);
    }
  }
  /// First guess of the stages from the polynomial of another step with these increments. If that leads
  /// further than `far` allows, the start itself is used, because sweeps would diverge there and functions of
  /// huge numbers are slow. @param offset 0 if this step starts where the other one does, 1 if it starts
  /// where that one ends @param ratio size of this step over that of the other one
  void begin(Step& step, const Vec& dq, const Vec& dp, double offset, double ratio) {
    if (offset != offset_ || ratio != ratio_) continue_at(offset, ratio);
    Columns continued = continued_;
    Scalar increment_of_q(0.0), increment_of_p(0.0), way_of_q(0.0), way_of_p(0.0);
    for (Eigen::Index i = 0; i < step.q.size(); ++i) {
      const Scalar q = continued * dq[i], p = continued * dp[i];
      increment_of_q = max_abs(increment_of_q, dq[i]);
      increment_of_p = max_abs(increment_of_p, dp[i]);
      way_of_q = max_abs(way_of_q, q);
      way_of_p = max_abs(way_of_p, p);
      step.q[i] = Scalar(step.start.state.q[i]) + q;
      step.p[i] = Scalar(step.start.state.p[i]) + p;
    }
    if (!(largest(way_of_q) <= far * largest(increment_of_q) &&
          largest(way_of_p) <= far * largest(increment_of_p)))
      begin(step);
  }

  /// Evaluates the field at the stages.
  void evaluate(Step& step) {
    forces(step);
    field().velocities(step, weight_);
  }
  /// The first half of a sweep: the forces.
  void forces(Step& step) { field().forces(step, weight_); }
  /// The second half: new momenta, velocities and new positions.
  [[gnu::noinline]] void stages(Step& step) { renew_all<false>(step); }
  /// The same as stages(). @return at each stage the largest change of an entry of q or p, in the scale of
  /// the entry
  [[gnu::noinline]] Scalar changed_stages(Step& step) { return renew_all<true>(step); }
  /// Renews all stages from the field at the present stages; positions do not use the new momenta.
  void sweep_at_once(Step& step) {
    evaluate(step);
    const State<n>&z = step.start.state, &low = step.start.low;
    renew<false>(step.q, step.dq, z.q, low.q, step.per.q);
    renew<false>(step.p, step.dp, z.p, low.p, step.per.p);
  }

  /// Begins the first sweep of the next step, from the polynomial of this step as known so far.
  void begin_next(const Step& step, Step& next) {
    put_behind(step, next);
    begin(next, step.dq, step.dp, 1.0, 1.0);
    forces(next);
  }
  /// A sweep of the next step, between the two halves of a sweep of this one: while one waits for divisions
  /// and roots, the other multiplies and adds. A later call of stages() completes it.
  void sweep_next(const Step& step, Step& next) {
    put_behind(step, next);
    stages(next);
    forces(next);
  }

  /// \f$h b_j\f$.
  [[nodiscard]] const Scalar& weight() const { return weight_; }

 private:
  struct Copied {  // a field that is copied with the equations
    explicit Copied(std::unique_ptr<Field> field) : its(std::move(field)) {}
    Copied(const Copied& other) : its(other.its->clone()) {}
    Copied& operator=(const Copied& other) {
      its = other.its->clone();
      return *this;
    }
    std::unique_ptr<Field> its;
  };
  template <bool look>
  [[gnu::always_inline]] Scalar renew_all(Step& step) {
    const State<n>&z = step.start.state, &low = step.start.low;
    const Scalar of_p = renew<look>(step.p, step.dp, z.p, low.p, step.per.p);
    field().velocities(step, weight_);
    return max_abs(of_p, renew<look>(step.q, step.dq, z.q, low.q, step.per.q));
  }
  /// x = start + low + mu dx. @return at each stage the largest change of an entry times `per`, if `look` is
  /// set
  template <bool look, class V, class W>
  Scalar renew(Vec& x, const Vec& dx, const V& start, const V& low, const W& per) const {
    Columns mu = mu_;
    Scalar change(0.0);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Scalar next = Scalar(start[i]) + mu.times(dx[i], Scalar(low[i]));
      if constexpr (look) change = max_abs(change, Scalar((next - x[i]) * Scalar(per[i])));
      x[i] = next;
    }
    return change;
  }

  // A local copy of the matrix, which nothing else changes, is kept in registers. From 8 columns on it is
  // written in halves and read as a whole, which takes as long as several entries: no gain at 18 entries, a
  // tenth at 64.
  static constexpr bool copied = w >= 8 && (n == dynamic || n > 24);
  using Columns = std::conditional_t<copied, const LaneMatrix<w>, const LaneMatrix<w>&>;
  static void put_behind(const Step& step, Step& next) {
    for (Eigen::Index i = 0; i < step.q.size(); ++i) {
      next.start.state.q[i] = step.start.state.q[i] + sum(step.dq[i]);
      next.start.state.p[i] = step.start.state.p[i] + sum(step.dp[i]);
    }
  }
  /// Sets the matrix of \f$\int_{o}^{o + r c_i} \ell_j / b_j\f$ for the offset o and the ratio r.
  [[gnu::noinline]] void continue_at(double offset, double ratio) {
    offset_ = offset;
    ratio_ = ratio;
    const int s = rule_.stages();
    if (offset == 1.0 && ratio == 1.0) {
      for (int i = 0; i < w; ++i)
        for (int j = 0; j < w; ++j)
          continued_.set(i, j, rule_.ahead(std::min(i, s - 1))[static_cast<std::size_t>(j)]);
      return;
    }
    // Computed from the Legendre polynomials at all stages at once. Their integrals vanish at both ends,
    // except that of the first one.
    Scalar way, integral[w], last(1.0);
    for (int i = 0; i < w; ++i)
      way.set(i, ratio * rule_.node(std::min(i, s - 1)));
    const Scalar x = 2.0 * (way + offset) - 1.0;
    integral[0] = way;
    Scalar now = x;
    for (int k = 1; k < s; ++k) {
      const Scalar next = ((2 * k + 1) * x * now - k * last) * (1.0 / (k + 1));
      integral[k] = (next - last) * (0.5 / (2 * k + 1));
      last = now;
      now = next;
    }
    for (int j = 0; j < s; ++j) {
      Scalar sum = rule_.series(j, 0) * integral[0];
      for (int k = 1; k < s; ++k)
        sum += rule_.series(j, k) * integral[k];
      continued_.set(j, sum);
    }
  }

  Copied field_;
  LaneMatrix<w> mu_, continued_;
  alignas(64) Scalar weight_{0.0};
  GaussRule rule_;
  double offset_ = -1.0, ratio_ = 0.0;
};

}  // namespace avi
