#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/autodiff/pack.hpp"
#include "avi/autodiff/recording.hpp"
#include "avi/collocation/stage_values.hpp"

#include <array>
#include <memory>
#include <type_traits>
#include <utility>

/// @file
/// The field of a transformed problem, Hamilton's equations, evaluated at several stages at once.

namespace avi {

/// Hamilton's equations of \f$\bar H\f$ at w stages at once. Forces and velocities are separate functions,
/// each of which computes only what it needs, because a sweep updates the momenta between them.
template <int n, int w>
class StageField {
 public:
  using Scalar = Pack<w>;          ///< One number for each stage.
  using Step = StageValues<n, w>;  ///< The stages, and the field there.

  virtual ~StageField() = default;
  StageField& operator=(const StageField&) = delete;  ///< See clone().

  /// Sets step.dp = -weight \f$\partial \bar H/\partial q\f$.
  virtual void forces(Step& step, const Scalar& weight) = 0;
  /// Sets step.dq = weight \f$\partial \bar H/\partial p\f$, at the positions of the last call of forces().
  virtual void velocities(Step& step, const Scalar& weight) = 0;
  /// The monitor g at the stages of a solved step, after a call of velocities().
  virtual const Scalar& rate(const Step& step) = 0;
  /// Physical time of a state; where time is also a coordinate, taken from there.
  [[nodiscard]] virtual double clock(const Vector<double, n>& q, double t) const = 0;
  /// A copy with its own memory.
  [[nodiscard]] virtual std::unique_ptr<StageField> clone() const = 0;

 protected:
  StageField() = default;
  StageField(const StageField&) = default;  ///< For derived classes.
};

namespace detail {
/// Largest n with automatic gradients by forward accumulation. Beyond it they come from a recording, whose
/// cost relative to H does not grow with n.
inline constexpr int most_partials = 8;
/// True where a gradient supplied by H is called directly beyond that n. This needs n at compile time, since
/// it would otherwise allocate memory; for n at run time the supplied gradient is recorded.
template <class Problem, int w>
inline constexpr bool
    takes_supplied = (Problem::dimension > most_partials) &&
                     SuppliesGradient<std::decay_t<decltype(std::declval<const Problem&>().hamiltonian())>,
                                      Pack<w>, Problem::dimension>;

/// The recording of \f$\bar H = g\,(H + p^t)\f$, with the gradient that H supplies.
template <class Problem>
Recording recorded_with_supplied(const Problem& problem) {
  const auto n = static_cast<int>(problem.size());
  ExpressionGraph graph(2 * n);
  const RecordedVector<> q = recorded_inputs(graph, 0, n), p = recorded_inputs(graph, n, n);
  const Recorded energy = problem.hamiltonian()(q, p);
  const Recorded value = problem.rate(q, p) * (energy + problem.energy_momentum());
  const int inner = energy.node_in(graph), outer = value.node_in(graph);
  const std::vector<int> supplied = supplied_gradient(problem.hamiltonian(), q, p, graph);
  return {std::move(graph), outer, inner, supplied};
}

/// The recording of g, or of \f$\bar H = g\,(H + p^t)\f$; made once for all pack widths.
template <class Problem>
Recording recorded_rate(const Problem& problem, bool with_energy) {
  using H = std::decay_t<decltype(problem.hamiltonian())>;
  if constexpr (Problem::dimension == dynamic && SuppliesGradient<H, Recorded, dynamic>)
    if (with_energy) return recorded_with_supplied(problem);
  return record<Problem::dimension>(
      [&](const auto& q, const auto& p) {
        const Recorded rate = problem.rate(q, p);
        return with_energy ? rate * (problem.hamiltonian()(q, p) + problem.energy_momentum()) : rate;
      },
      problem.size());
}

}  // namespace detail

/// The field of \f$\bar H = g\,(H + p^t)\f$. Gradients are those that H supplies, or automatic ones by
/// forward accumulation; in larger dimensions the gradient of the monitor is recorded. The functions of the
/// problem are inlined ([[gnu::flatten]]), so that a formula is evaluated in registers, regardless of the
/// rest of the program.
template <class Problem, int w>
class FieldOf final : public StageField<Problem::dimension, w> {
  using Base = StageField<Problem::dimension, w>;

 public:
  static constexpr int n = Problem::dimension;  ///< Degrees of freedom.
  using typename Base::Scalar, typename Base::Step;

  /// For this problem, which is copied.
  explicit FieldOf(const Problem& problem) : problem_(problem), monitor_(recorded(problem)) {}

  [[gnu::flatten, gnu::noinline]] void forces(Step& step, const Scalar& weight) override {
    field<true>(step, -weight, step.dp);
  }
  [[gnu::flatten, gnu::noinline]] void velocities(Step& step, const Scalar& weight) override {
    field<false>(step, weight, step.dq);
  }
  const Scalar& rate(const Step& step) override { return step.rate; }
  [[nodiscard]] double clock(const Vector<double, n>& q, double t) const override {
    return problem_.clock(q, t);
  }
  [[nodiscard]] std::unique_ptr<Base> clone() const override { return std::make_unique<FieldOf>(*this); }

 private:
  static constexpr bool many = n > detail::most_partials;
  struct Nothing {};
  using Monitor = std::conditional_t<many, std::array<detail::RecordedFormula<Scalar>, 2>, Nothing>;
  static Monitor recorded([[maybe_unused]] const Problem& problem) {
    if constexpr (many) {
      const Recording g = detail::recorded_rate(problem, false);
      return {{{g.value_and_gradient(0, n)}, {g.value_and_gradient(n, n)}}};
    } else {
      return {};
    }
  }

  /// out = weight \f$\partial \bar H/\partial q\f$, or by p.
  template <bool by_q>
  void field(Step& step, const Scalar& weight, Vector<Scalar, n>& out) {
    const Problem& problem = problem_;
    const auto& h = problem.hamiltonian();
    constexpr bool rate_is_known = Problem::unit || (Problem::position_monitor && !by_q);
    Scalar energy;
    if constexpr (SuppliesGradient<std::decay_t<decltype(h)>, Scalar, n>) {
      if constexpr (by_q)
        out = h.d_dq(step.q, step.p);
      else
        out = h.d_dp(step.q, step.p);
      if constexpr (!rate_is_known) energy = h(step.q, step.p);
    } else {
      const Partials<Scalar, n> value = differentiated<by_q>(h, step.q, step.p);
      energy = value.value;
      for (int i = 0; i < n; ++i)
        out[i] = value.partial(i);
    }
    [[maybe_unused]] const auto add = [&](const Scalar& g, const auto& partial) {
      const Scalar along = weight * g, across = weight * (energy + Scalar(problem.energy_momentum()));
      for (int i = 0; i < n; ++i)
        out[i] = along * out[i] + across * partial(i);
      step.rate = g;
    };
    if constexpr (rate_is_known) {
      const Scalar along = Problem::unit ? weight : weight * step.rate;
      for (int i = 0; i < n; ++i)
        out[i] = along * out[i];
    } else if constexpr (many) {
      auto& g = monitor_[by_q ? 0 : 1];
      g.run(step.q, step.p);
      add(g.value(), [&](int i) { return g.partial(i); });
    } else {
      const Partials<Scalar, n> g = [&] {
        if constexpr (Problem::position_monitor)
          return value_and_gradient(problem.monitor(), step.q);
        else
          return differentiated<by_q>(problem.monitor(), step.q, step.p);
      }();
      add(g.value, [&](int i) { return g.partial(i); });
    }
  }

  Problem problem_;
  Monitor monitor_;
};

/// The same where n is known only at run time, or is large: the gradients come from a recording of \f$\bar
/// H\f$, by reverse accumulation, at a cost relative to H that does not grow with n.
template <class Problem, int w>
requires((Problem::dimension == dynamic || Problem::dimension > detail::most_partials) &&
         !detail::takes_supplied<Problem, w>) class FieldOf<Problem, w> final
    : public StageField<Problem::dimension, w> {
  using Base = StageField<Problem::dimension, w>;

 public:
  static constexpr int n = Problem::dimension;  ///< Degrees of freedom, or avi::dynamic.
  using typename Base::Scalar, typename Base::Step;

  /// Records this problem, which is copied.
  explicit FieldOf(const Problem& problem)
      : FieldOf(problem, detail::recorded_rate(problem, true), detail::recorded_rate(problem, false)) {}

  void forces(Step& step, const Scalar& weight) override { field(forces_, step, -weight, step.dp); }
  void velocities(Step& step, const Scalar& weight) override { field(velocities_, step, weight, step.dq); }
  const Scalar& rate(const Step& step) override {
    rates_.run(step.q, step.p);
    return rates_.value();
  }
  [[nodiscard]] double clock(const Vector<double, n>& q, double t) const override {
    return problem_.clock(q, t);
  }
  [[nodiscard]] std::unique_ptr<Base> clone() const override { return std::make_unique<FieldOf>(*this); }

 private:
  using Formula = detail::RecordedFormula<Scalar>;
  FieldOf(const Problem& problem, const Recording& transformed, const Recording& rate)
      : problem_(problem), forces_{transformed.gradient(0, size(problem))},
        velocities_{transformed.gradient(size(problem), size(problem))}, rates_{rate.value()} {}
  static int size(const Problem& problem) { return static_cast<int>(problem.size()); }
  static void field(Formula& slopes, const Step& step, const Scalar& weight, Vector<Scalar, n>& out) {
    slopes.run(step.q, step.p);
    for (int i = 0; i < slopes.program.slopes(); ++i)
      out[i] = weight * slopes.partial(i);
  }
  Problem problem_;
  Formula forces_, velocities_, rates_;
};

}  // namespace avi
