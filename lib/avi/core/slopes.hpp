#pragma once
#include "avi/core/hamiltonian.hpp"

#include <algorithm>
#include <utility>

/// @file
/// First derivatives of f(q, p), written in place, for a dimension known at compile time or at run time.

namespace avi {

/// Which argument of f(q, p) is differentiated.
enum class Argument { position, momentum };

/// Work space of slope() and value_and_work().
template <class S, int n>
struct Room {
  explicit Room(Eigen::Index) {}  ///< n is in the type.
  Vector<S, n> slope;             ///< A gradient.
};

/// Work space at run-time dimension, allocated once, so that derivatives allocate nothing.
template <class S>
struct Room<S, dynamic> {
  static constexpr int width = 2;  ///< Partials that are carried at a time.
  /// Vectors of `size` entries.
  explicit Room(Eigen::Index size) : moving(size), still(size), along(size), beside(size), slope(size) {}
  Vector<Partials<S, width>, dynamic> moving;  ///< The argument that slope() differentiates.
  Vector<Partials<S, width>, dynamic> still;   ///< The other one.
  Vector<Partials<S, 1>, dynamic> along;       ///< p, as it moves along itself.
  Vector<Partials<S, 1>, dynamic> beside;      ///< q meanwhile.
  Vector<S, dynamic> slope;                    ///< A gradient.
};

/// out = df/dq or df/dp at any scalar.
template <Argument which, class F, class S, int n>
void slope(const F& f, const Vector<S, n>& q, const Vector<S, n>& p, Vector<S, n>& out, Room<S, n>& room) {
  constexpr bool position = which == Argument::position;
  const auto call = [&](const auto& moving, const auto& still) {
    if constexpr (position)
      return f(moving, still);
    else
      return f(still, moving);
  };
  const Vector<S, n>&x = position ? q : p, &y = position ? p : q;
  if constexpr (n != dynamic) {
    (void)room;
    const Vector<Partials<S, n>, n> still = y.template cast<Partials<S, n>>();
    out = gradient([&](const auto& moving) { return call(moving, still); }, x);
  } else {
    using P = typename decltype(room.moving)::Scalar;
    constexpr Eigen::Index width = Room<S, n>::width;
    const Eigen::Index size = x.size();
    for (Eigen::Index i = 0; i < size; ++i) {
      room.moving[i] = P(x[i]);
      room.still[i] = P(y[i]);
    }
    for (Eigen::Index first = 0; first < size; first += width) {
      const Eigen::Index last = std::min(first + width, size);
      for (Eigen::Index i = first; i < last; ++i)
        room.moving[i] = P::variable(x[i], static_cast<int>(i - first));
      const P value = call(room.moving, room.still);
      for (Eigen::Index i = first; i < last; ++i) {
        out[i] = value.partial(static_cast<int>(i - first));
        room.moving[i] = P(x[i]);
      }
    }
  }
}

/// out = dH/dq or dH/dp, the supplied one where H supplies it.
template <Argument which, class H, class S, int n>
void energy_slope(const H& h, const Vector<S, n>& q, const Vector<S, n>& p, Vector<S, n>& out,
                  Room<S, n>& room) {
  if constexpr (SuppliesGradient<H, S, n>) {
    if constexpr (which == Argument::position)
      out = h.d_dq(q, p);
    else
      out = h.d_dp(q, p);
  } else {
    slope<which>(h, q, p, out, room);
  }
}

/// f(q, p) and \f$p\cdot\partial f/\partial p\f$ at any scalar.
template <class F, class S, int n>
std::pair<S, S> value_and_work(const F& f, const Vector<S, n>& q, const Vector<S, n>& p, Room<S, n>& room) {
  if constexpr (SuppliesGradient<F, S, n>) {
    room.slope = f.d_dp(q, p);
    S sum(0.0);
    for (Eigen::Index i = 0; i < p.size(); ++i)
      sum += p[i] * room.slope[i];
    return {f(q, p), sum};
  } else if constexpr (n != dynamic) {
    const Vector<Partials<S, 1>, n> at_q = q.template cast<Partials<S, 1>>();
    const auto both = along_momentum([&](const auto& x) { return f(at_q, x); }, p);
    return {both.value, both.partial(0)};
  } else {
    using P = Partials<S, 1>;
    for (Eigen::Index i = 0; i < p.size(); ++i) {
      room.along[i] = P::variable(p[i], 0, p[i]);
      room.beside[i] = P(q[i]);
    }
    const P both = f(room.beside, room.along);
    return {both.value, both.partial(0)};
  }
}

}  // namespace avi
