#pragma once
#include <complex>

/// @file
/// What two-stage Gauss collocation does to a spring, by hand and in more digits than a double has.

/// The spring H = (p^2 + q^2)/2 as z = q + i p: its orbit is z e^(-it), and a step of order 4 multiplies z by
/// the Pade approximant of that. Steps h, then a shorter one to the time t.
inline std::complex<long double> by_hand(std::complex<long double> z, long double h, long double t) {
  using Complex = std::complex<long double>;
  const auto factor = [](long double x) {
    const Complex up{1.0L - x * x / 12.0L, -0.5L * x};
    return up / std::conj(up);
  };
  const long double sense = t < 0.0L ? -1.0L : 1.0L;
  long double at = 0.0L;
  for (; at + h <= sense * t; at += h)
    z *= factor(sense * h);
  return z * factor(t - sense * at);
}
