#pragma once
#include "avi/autodiff/jet.hpp"

#include <cmath>

/// @file
/// Elementary functions of a Jet: each adds coefficient k from the differential equation that the function
/// satisfies (Jorba and Zou 2005, Proposition 1; Neidinger 2013).

namespace avi {

/// c = sqrt(a): c^2 = a.
template <class T, int R, int K>
Jet<T, R, K> sqrt(const Jet<T, R, K>& a) {
  using std::sqrt;
  if (a.is_constant()) return Jet<T, R, K>(sqrt(a.constant));
  const int k = a.order();
  T* c = a.slot();
  if (k == 0) {
    c[0] = sqrt(a.coefficients[0]);
    c[R + 1] = 0.5 / c[0];
  } else {
    c[k] = (a.coefficients[k] - detail::Convolution<T, K>::sum(c, c, k, 1, k - 1)) * c[R + 1];
  }
  return {c, a.tape};
}

/// c = a^alpha for constant alpha: a c' = alpha c a'.
template <class T, int R, int K>
Jet<T, R, K> pow(const Jet<T, R, K>& a, double alpha) {
  if (alpha == 0.0) return Jet<T, R, K>(1.0);
  if (alpha == 1.0) return a;
  if (alpha == 2.0) return a * a;
  if (a.is_constant()) return Jet<T, R, K>(power(a.constant, alpha));
  const int k = a.order();
  T* c = a.slot();
  if (k == 0) {
    c[0] = power(a.coefficients[0], alpha);
    c[R + 1] = 1.0 / a.coefficients[0];
  } else {
    c[k] = detail::Convolution<T, K>::weighted(a.coefficients, c, k, alpha + 1.0, -k) * c[R + 1];
  }
  return {c, a.tape};
}

/// c = exp(a): c' = c a'.
template <class T, int R, int K>
Jet<T, R, K> exp(const Jet<T, R, K>& a) {
  using std::exp;
  if (a.is_constant()) return Jet<T, R, K>(exp(a.constant));
  const int k = a.order();
  T* c = a.slot();
  if (k == 0) {
    c[0] = exp(a.coefficients[0]);
  } else {
    c[k] = detail::Convolution<T, K>::weighted(a.coefficients, c, k, 1.0, 0.0);
  }
  return {c, a.tape};
}

/// c = log(a): a c' = a'.
template <class T, int R, int K>
Jet<T, R, K> log(const Jet<T, R, K>& a) {
  using std::log;
  if (a.is_constant()) return Jet<T, R, K>(log(a.constant));
  const int k = a.order();
  T* c = a.slot();
  if (k == 0) {
    c[0] = log(a.coefficients[0]);
    c[R + 1] = 1.0 / a.coefficients[0];
  } else {
    c[k] = T(0.0);  // so that the sum ends at j = k - 1
    c[k] =
        (a.coefficients[k] - detail::Convolution<T, K>::weighted(c, a.coefficients, k, 1.0, 0.0)) * c[R + 1];
  }
  return {c, a.tape};
}

/// A function and its partner, of which each is, up to sign, the other's derivative.
template <class Series>
struct JetPair {
  Series first;   ///< sin or sinh
  Series second;  ///< cos or cosh
};

namespace detail {
/// s' = c a', c' = sign s a', from the values at order 0.
template <class T, int R, int K, class First, class Second>
JetPair<Jet<T, R, K>> coupled(const Jet<T, R, K>& a, double sign, First first, Second second) {
  if (a.is_constant()) return {Jet<T, R, K>(first(a.constant)), Jet<T, R, K>(second(a.constant))};
  const int k = a.order();
  T* s = a.slot();
  T* c = a.slot();
  if (k == 0) {
    s[0] = first(a.coefficients[0]);
    c[0] = second(a.coefficients[0]);
  } else {
    s[k] = Convolution<T, K>::weighted(a.coefficients, c, k, 1.0, 0.0);
    c[k] = Convolution<T, K>::weighted(a.coefficients, s, k, sign, 0.0);
  }
  return {{s, a.tape}, {c, a.tape}};
}
}  // namespace detail

/// (sin a, cos a) for the price of one.
template <class T, int R, int K>
JetPair<Jet<T, R, K>> sin_cos(const Jet<T, R, K>& a) {
  return detail::coupled(
      a, -1.0,
      [](const auto& x) {
        using std::sin;
        return sin(x);
      },
      [](const auto& x) {
        using std::cos;
        return cos(x);
      });
}

/// (sinh a, cosh a) for the price of one.
template <class T, int R, int K>
JetPair<Jet<T, R, K>> sinh_cosh(const Jet<T, R, K>& a) {
  return detail::coupled(
      a, 1.0,
      [](const auto& x) {
        using std::sinh;
        return sinh(x);
      },
      [](const auto& x) {
        using std::cosh;
        return cosh(x);
      });
}

/// @name Functions built from the pairs
/// @{

/// One of the pair, or their quotient.
template <class T, int R, int K>
Jet<T, R, K> sin(const Jet<T, R, K>& a) {
  return sin_cos(a).first;
}
template <class T, int R, int K>
Jet<T, R, K> cos(const Jet<T, R, K>& a) {
  return sin_cos(a).second;
}
template <class T, int R, int K>
Jet<T, R, K> sinh(const Jet<T, R, K>& a) {
  return sinh_cosh(a).first;
}
template <class T, int R, int K>
Jet<T, R, K> cosh(const Jet<T, R, K>& a) {
  return sinh_cosh(a).second;
}
template <class T, int R, int K>
Jet<T, R, K> tan(const Jet<T, R, K>& a) {
  const auto [s, c] = sin_cos(a);
  return s / c;
}
/// @}

namespace detail {
/// c with c' = a' / w, from its value at order 0, where w is a series known to the same order.
template <class T, int R, int K, class Function>
Jet<T, R, K> integral_of_quotient(const Jet<T, R, K>& a, const Jet<T, R, K>& w, Function function) {
  const int k = a.order();
  T* c = a.slot();
  if (k == 0) {
    c[0] = function(a.coefficients[0]);
    c[R + 1] = 1.0 / w.coefficients[0];
  } else {
    c[k] = T(0.0);  // so that the sum ends at j = k - 1
    c[k] = (a.coefficients[k] - Convolution<T, K>::weighted(c, w.coefficients, k, 1.0, 0.0)) * c[R + 1];
  }
  return {c, a.tape};
}
}  // namespace detail

/// c = atan(a): (1 + a^2) c' = a'.
template <class T, int R, int K>
Jet<T, R, K> atan(const Jet<T, R, K>& a) {
  using std::atan;
  if (a.is_constant()) return Jet<T, R, K>(atan(a.constant));
  return detail::integral_of_quotient(a, a * a + 1.0, [](const auto& x) {
    using std::atan;
    return atan(x);
  });
}

/// c = tanh(a), from the quotient that does not overflow.
template <class T, int R, int K>
Jet<T, R, K> tanh(const Jet<T, R, K>& a) {
  using std::tanh;
  if (a.is_constant()) return Jet<T, R, K>(tanh(a.constant));
  // tanh a = (1 - u) / (1 + u), u = exp(-2 |a|), up to the sign of a.
  const double sign = a.value() < 0.0 ? -1.0 : 1.0;
  const Jet<T, R, K> u = exp((-2.0 * sign) * a);
  return sign * ((1.0 - u) / (1.0 + u));
}

/// |a|, by the sign of its value.
template <class T, int R, int K>
Jet<T, R, K> abs(const Jet<T, R, K>& a) {
  return a.value() < 0.0 ? -a : a;
}

}  // namespace avi
