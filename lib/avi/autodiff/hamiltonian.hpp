#pragma once
#include "avi/autodiff/partials.hpp"
#include "avi/core/vector.hpp"

/// @file
/// Derivatives of a Hamiltonian H(q, p): those that it supplies, else automatic ones.

namespace avi {

/// A Hamiltonian may supply d_dp(q, p) = dH/dp and d_dq(q, p) = dH/dq for speed, both generic in their
/// scalar.
template <class H, class S, int n>
concept SuppliesGradient = requires(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  h.d_dp(q, p);
  h.d_dq(q, p);
};

/// x at another scalar, with derivatives that vanish. A loop compiles faster than Eigen's cast.
template <class To, class S, int n>
Vector<To, n> constants(const Vector<S, n>& x) {
  Vector<To, n> y(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    y[i] = To(x[i]);
  return y;
}

/// H and its automatic derivatives by q, or by p, at any scalar.
template <bool by_q, class H, class S, int n>
Partials<S, n> differentiated(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  const auto other = constants<Partials<S, n>>(by_q ? p : q);
  const auto along = [&](const auto& x) {
    if constexpr (by_q)
      return h(x, other);
    else
      return h(other, x);
  };
  return value_and_gradient(along, by_q ? q : p);
}

/// H and dH/dp at any scalar.
template <class H, class S, int n>
Partials<S, n> value_and_d_dp(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  if constexpr (SuppliesGradient<H, S, n>)
    return {h(q, p), h.d_dp(q, p)};
  else
    return differentiated<false>(h, q, p);
}

/// dH/dp at any scalar.
template <class H, class S, int n>
Vector<S, n> d_dp(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  if constexpr (SuppliesGradient<H, S, n>)
    return h.d_dp(q, p);
  else
    return differentiated<false>(h, q, p).gradient();
}

/// dH/dq at any scalar.
template <class H, class S, int n>
Vector<S, n> d_dq(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  if constexpr (SuppliesGradient<H, S, n>)
    return h.d_dq(q, p);
  else
    return differentiated<true>(h, q, p).gradient();
}

/// A Hamiltonian stripped of what it supplies: only its value is used and every derivative is automatic.
template <class H>
struct Automatic {
  H hamiltonian;  ///< Called as H(q, p), never for its gradient.
  /// H(q, p).
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return hamiltonian(q, p);
  }
};
/// Automatic{hamiltonian}.
template <class H>
Automatic(H) -> Automatic<H>;

}  // namespace avi
