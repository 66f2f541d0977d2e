#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/autodiff/pack.hpp"
#include "avi/autodiff/recording.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

/// @file
/// Hamilton's equations of a transformed problem at several stages side by side.

namespace avi {

namespace detail {
/// In larger dimensions automatic gradients come from a recording: their cost relative to H does not grow
/// with n.
inline constexpr int most_partials = 8;
/// A supplied gradient is called beyond it too, if only n is known to the compiler: it then is no allocation.
/// Where n is not, it is recorded.
template <class Problem, int w>
inline constexpr bool
    takes_supplied = (Problem::dimension > most_partials) &&
                     SuppliesGradient<std::decay_t<decltype(std::declval<const Problem&>().hamiltonian())>,
                                      Pack<w>, Problem::dimension>;

/// The recording of \f$\bar H = g\,(H + p^t)\f$ with the gradient that H supplies for recorded numbers.
template <class Problem>
Recording recorded_with_supplied(const Problem& problem) {
  using Vec = Vector<Recorded, dynamic>;
  const Eigen::Index n = problem.size();
  const auto apart = [n](const auto& use) {
    return [use, n](const Vec& z) { return use(part(z, 0, n), part(z, n, n)); };
  };
  const auto& h = problem.hamiltonian();
  return {[&](const Vec& z, const Recorded& energy) -> Recorded {
            const Vec q = part(z, 0, n), p = part(z, n, n);
            return problem.rate(q, p) * (energy + problem.energy_momentum());
          },
          apart([&](const Vec& q, const Vec& p) -> Recorded { return h(q, p); }),
          apart([&](const Vec& q, const Vec& p) {
            Vec slopes(2 * n);
            slopes << h.d_dq(q, p), h.d_dp(q, p);
            return slopes;
          }),
          2 * n};
}

/// The recording of g, or of \f$\bar H = g\,(H + p^t)\f$: made once for all widths.
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

/// The field of \f$\bar H = g\,(H + p^t)\f$ at w stages, as two functions, of which each computes only what
/// it needs: a sweep updates the momenta between them. Gradients are those that H supplies, or automatic ones
/// by forward accumulation.
template <class Problem, int w>
class StageField {
 public:
  static constexpr int n = Problem::dimension;  ///< Degrees of freedom.
  using Scalar = Pack<w>;                       ///< One number for each stage.
  using Vec = Vector<Scalar, n>;                ///< One vector for each stage.

  /// For this problem.
  explicit StageField(const Problem&) {}

  /// force = -weight \f$\partial \bar H/\partial q\f$.
  void force(const Problem& problem, const Vec& q, const Vec& p, const Scalar& weight, Scalar& rate,
             Vec& force) {
    const auto at_q = [&](const auto& f) {
      return [&](const auto& x) { return f(x, constants<ScalarOf<decltype(x)>>(p)); };
    };
    const H& h = problem.hamiltonian();
    Scalar energy;
    if constexpr (SuppliesGradient<H, Scalar, n>) {
      force = h.d_dq(q, p);
      if constexpr (!Problem::unit) energy = h(q, p);
    } else {
      const Partials<Scalar, n> value = value_and_gradient(at_q(h), q);
      energy = value.value;
      for (int i = 0; i < n; ++i)
        force[i] = value.partial(i);
    }
    const Scalar minus = -weight;
    if constexpr (Problem::unit) {
      for (int i = 0; i < n; ++i)
        force[i] = minus * force[i];
    } else {
      Partials<Scalar, n> g;
      if constexpr (Problem::position_monitor)
        g = value_and_gradient(problem.monitor(), q);
      else
        g = value_and_gradient(at_q(problem.monitor()), q);
      const Scalar along = minus * g.value, across = minus * (energy + Scalar(problem.energy_momentum()));
      for (int i = 0; i < n; ++i)
        force[i] = along * force[i] + across * g.partial(i);
      rate = g.value;
    }
  }

  /// velocity = weight \f$\partial \bar H/\partial p\f$, at the positions of the last call of force().
  void velocity(const Problem& problem, const Vec& q, const Vec& p, const Scalar& weight, Scalar& rate,
                Vec& velocity) {
    const auto at_p = [&](const auto& f) {
      return [&](const auto& x) { return f(constants<ScalarOf<decltype(x)>>(q), x); };
    };
    const H& h = problem.hamiltonian();
    Scalar energy;
    if constexpr (SuppliesGradient<H, Scalar, n>) {
      velocity = h.d_dp(q, p);
      if constexpr (!Problem::position_monitor) energy = h(q, p);
    } else {
      const Partials<Scalar, n> value = value_and_gradient(at_p(h), p);
      energy = value.value;
      for (int i = 0; i < n; ++i)
        velocity[i] = value.partial(i);
    }
    if constexpr (!Problem::position_monitor) {
      const Partials<Scalar, n> g = value_and_gradient(at_p(problem.monitor()), p);
      const Scalar along = weight * g.value, across = weight * (energy + Scalar(problem.energy_momentum()));
      for (int i = 0; i < n; ++i)
        velocity[i] = along * velocity[i] + across * g.partial(i);
      rate = g.value;
    } else {
      const Scalar along = weight * rate;  // 1 where the monitor is Unit
      for (int i = 0; i < n; ++i)
        velocity[i] = along * velocity[i];
    }
  }

  /// g, which a sweep leaves in `rate`.
  [[nodiscard]] static const Scalar& rate(const Scalar& rate) { return rate; }

 private:
  using H = std::decay_t<decltype(std::declval<const Problem&>().hamiltonian())>;
  template <class Differentiated>
  using ScalarOf = typename std::decay_t<Differentiated>::Scalar;
};

/// The same where n is known at run time only, or large: the gradients are those of a recording of
/// \f$\bar H\f$, by reverse accumulation, at a cost that does not grow with n.
template <class Problem, int w>
requires((Problem::dimension == dynamic || Problem::dimension > detail::most_partials) &&
         !detail::takes_supplied<Problem, w>) class StageField<Problem, w> {
 public:
  static constexpr int n = Problem::dimension;  ///< Degrees of freedom, or avi::dynamic.
  using Scalar = Pack<w>;                       ///< One number for each stage.
  using Vec = Vector<Scalar, n>;                ///< One vector for each stage.

  /// Records this problem.
  explicit StageField(const Problem& problem)
      : StageField(problem.size(), detail::recorded_rate(problem, true),
                   detail::recorded_rate(problem, false)) {}

  /// force = -weight \f$\partial \bar H/\partial q\f$.
  void force(const Problem&, const Vec& q, const Vec& p, const Scalar& weight, Scalar&, Vec& force) {
    evaluate(forces_, force_room_, q, p);
    const Scalar minus = -weight;
    for (int i = 0; i < forces_.slopes(); ++i)
      force[i] = minus * forces_.slope(force_room_, i);
  }
  /// velocity = weight \f$\partial \bar H/\partial p\f$.
  void velocity(const Problem&, const Vec& q, const Vec& p, const Scalar& weight, Scalar&, Vec& velocity) {
    evaluate(velocities_, velocity_room_, q, p);
    for (int i = 0; i < velocities_.slopes(); ++i)
      velocity[i] = weight * velocities_.slope(velocity_room_, i);
  }
  /// g of the last call of velocity().
  [[nodiscard]] const Scalar& rate(const Scalar&) {
    const Scalar* last = velocity_room_.arguments();
    std::copy(last, last + rates_.inputs(), rate_room_.arguments());
    rates_.run(rate_room_);
    return rates_.value(rate_room_);
  }

 private:
  StageField(Eigen::Index size, const Recording& transformed, const Recording& rate)
      : forces_(transformed.gradient(0, static_cast<int>(size))),
        velocities_(transformed.gradient(static_cast<int>(size), static_cast<int>(size))),
        rates_(rate.value()), force_room_(forces_), velocity_room_(velocities_), rate_room_(rates_) {}
  static void evaluate(const Program& program, Program::Room<Scalar>& room, const Vec& q, const Vec& p) {
    std::copy(q.data(), q.data() + q.size(), room.arguments());
    std::copy(p.data(), p.data() + p.size(), room.arguments() + q.size());
    program.run(room);
  }
  Program forces_, velocities_, rates_;
  Program::Room<Scalar> force_room_, velocity_room_, rate_room_;
};

}  // namespace avi
