#pragma once
#include "avi/autodiff/jet.hpp"
#include "avi/autodiff/partials.hpp"

#include <cmath>

/// @file
/// Elementary functions of a Jet. What each does to the coefficients, says SeriesOperation.

namespace avi {

/// @name Elementary functions
/// @{

/// Of the series; of a constant, the constant.
template <class T, int R>
Jet<T, R> sqrt(const Jet<T, R>& a) {
  return a.is_constant() ? Jet<T, R>(std::sqrt(a.constant)) : a.through(SeriesOperation::sqrt);
}
template <class T, int R>
Jet<T, R> pow(const Jet<T, R>& a, double alpha) {
  if (alpha == 0.0) return Jet<T, R>(1.0);
  if (alpha == 1.0) return a;
  if (alpha == 2.0) return a * a;
  return a.is_constant() ? Jet<T, R>(power(a.constant, alpha)) : a.through(SeriesOperation::power, alpha);
}
template <class T, int R>
Jet<T, R> exp(const Jet<T, R>& a) {
  return a.is_constant() ? Jet<T, R>(std::exp(a.constant)) : a.through(SeriesOperation::exp);
}
template <class T, int R>
Jet<T, R> log(const Jet<T, R>& a) {
  return a.is_constant() ? Jet<T, R>(std::log(a.constant)) : a.with(SeriesOperation::log, a);
}
template <class T, int R>
Jet<T, R> atan(const Jet<T, R>& a) {
  return a.is_constant() ? Jet<T, R>(std::atan(a.constant)) : a.with(SeriesOperation::atan, a * a + 1.0);
}
template <class T, int R>
Jet<T, R> abs(const Jet<T, R>& a) {
  return a.is_constant() ? Jet<T, R>(std::abs(a.constant)) : a.through(SeriesOperation::absolute);
}
/// With derivatives. The sign is written down: a look at the value would have the formula called anew for
/// every expansion.
template <class T, int R, int N>
Partials<Jet<T, R>, N> abs(const Partials<Jet<T, R>, N>& x) {
  return x.chain(abs(x.value), [&] {
    return x.value.is_constant() ? Jet<T, R>(std::copysign(1.0, x.value.constant))
                                 : x.value.through(SeriesOperation::sign);
  });
}
/// @}

/// A function and its partner, of which each is, up to sign, the other's derivative.
template <class Series>
struct JetPair {
  Series first;   ///< sin or sinh
  Series second;  ///< cos or cosh
};

/// (sin a, cos a) for the price of one.
template <class T, int R>
JetPair<Jet<T, R>> sin_cos(const Jet<T, R>& a) {
  if (a.is_constant()) return {std::sin(a.constant), std::cos(a.constant)};
  const Jet<T, R> s = a.through(SeriesOperation::sin), c = a.through(SeriesOperation::cos);
  a.tape->pair();
  return {s, c};
}

/// (sinh a, cosh a) for the price of one.
template <class T, int R>
JetPair<Jet<T, R>> sinh_cosh(const Jet<T, R>& a) {
  if (a.is_constant()) return {std::sinh(a.constant), std::cosh(a.constant)};
  const Jet<T, R> s = a.through(SeriesOperation::sinh), c = a.through(SeriesOperation::cosh);
  a.tape->pair();
  return {s, c};
}

/// @name Functions built from others
/// @{

/// One of a pair, or a quotient.
template <class T, int R>
Jet<T, R> sin(const Jet<T, R>& a) {
  return sin_cos(a).first;
}
template <class T, int R>
Jet<T, R> cos(const Jet<T, R>& a) {
  return sin_cos(a).second;
}
template <class T, int R>
Jet<T, R> sinh(const Jet<T, R>& a) {
  return sinh_cosh(a).first;
}
template <class T, int R>
Jet<T, R> cosh(const Jet<T, R>& a) {
  return sinh_cosh(a).second;
}
template <class T, int R>
Jet<T, R> tan(const Jet<T, R>& a) {
  const auto [s, c] = sin_cos(a);
  return s / c;
}
template <class T, int R>
Jet<T, R> tanh(const Jet<T, R>& a) {
  if (a.is_constant()) return Jet<T, R>(std::tanh(a.constant));
  // The quotient that does not overflow: (1 - u) / (1 + u), u = exp(-2 |a|), up to the sign of a.
  const double sign = a.value() < 0.0 ? -1.0 : 1.0;
  const Jet<T, R> u = exp((-2.0 * sign) * a);
  return sign * ((1.0 - u) / (1.0 + u));
}
/// @}

}  // namespace avi
