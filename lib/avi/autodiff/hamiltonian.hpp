#pragma once
#include "avi/autodiff/partials.hpp"
#include "avi/core/vector.hpp"

/// @file
/// Derivatives of a Hamiltonian H(q, p): the gradient that it supplies, otherwise an automatic one.

namespace avi {

/// True where a Hamiltonian supplies its own gradient, d_dp(q, p) = dH/dp and d_dq(q, p) = dH/dq, for speed.
/// Both must be generic in their scalar.
template <class H, class S, int n>
concept SuppliesGradient = requires(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  h.d_dp(q, p);
  h.d_dq(q, p);
};

/// The vector x converted to another scalar, as constants: all derivatives are zero. The loop compiles faster
/// than Eigen's cast.
template <class To, class S, int n>
Vector<To, n> constants(const Vector<S, n>& x) {
  Vector<To, n> y(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    y[i] = To(x[i]);
  return y;
}

/// H and its automatic derivatives with respect to q or p, for any scalar. @tparam by_q true for dH/dq, false
/// for dH/dp
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

/// H and dH/dp for any scalar.
template <class H, class S, int n>
Partials<S, n> value_and_d_dp(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  if constexpr (SuppliesGradient<H, S, n>)
    return {h(q, p), h.d_dp(q, p)};
  else
    return differentiated<false>(h, q, p);
}

/// dH/dp for any scalar.
template <class H, class S, int n>
Vector<S, n> d_dp(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  if constexpr (SuppliesGradient<H, S, n>)
    return h.d_dp(q, p);
  else
    return differentiated<false>(h, q, p).gradient();
}

/// dH/dq for any scalar.
template <class H, class S, int n>
Vector<S, n> d_dq(const H& h, const Vector<S, n>& q, const Vector<S, n>& p) {
  if constexpr (SuppliesGradient<H, S, n>)
    return h.d_dq(q, p);
  else
    return differentiated<true>(h, q, p).gradient();
}

/// A Hamiltonian without its supplied gradient: only its value is used, and all derivatives are automatic.
template <class H>
struct Automatic {
  H hamiltonian;  ///< Called as H(q, p) only.
  /// H(q, p).
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return hamiltonian(q, p);
  }
};
/// Deduces the type in Automatic{hamiltonian}.
template <class H>
Automatic(H) -> Automatic<H>;

}  // namespace avi
