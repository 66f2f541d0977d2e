#pragma once
#include "avi/autodiff/scalar.hpp"
#include "avi/core/power.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

/// The elementary functions of every scalar, and then its arithmetic, in formulas of x, y > 0 that are
/// generic in it.
inline const auto elementary = std::tuple{
    [](const auto& x, const auto& y) {
      using std::exp, std::log;
      return exp(x) * log(y);
    },
    [](const auto& x, const auto& y) {
      using std::sin, std::cos, std::tan;
      return sin(x) * cos(y) + tan(x);
    },
    [](const auto& x, const auto& y) {
      using std::sinh, std::cosh, std::tanh;
      return sinh(x) * cosh(y) + tanh(y);
    },
    [](const auto& x, const auto& y) {
      using std::atan, std::abs;
      return atan(x) * abs(x - y);
    },
    [](const auto& x, const auto& y) {
      using std::asin, std::acos, std::atanh;
      return asin(x / (x + y)) - acos(y / (x + y)) * atanh(x / (x + 2.0 * y));
    },
    [](const auto& x, const auto& y) {
      using std::asinh, std::acosh, std::cbrt;
      return asinh(x - y) * acosh(1.5 + x) + cbrt(y) + cbrt(-x);
    },
    [](const auto& x, const auto& y) {
      using std::expm1, std::log1p, std::fabs;
      return expm1(-x) * log1p(y) + fabs(x - 2.0 * y);
    },
    [](const auto& x, const auto& y) {
      using std::erf, std::erfc;
      return erf(x) * erfc(x - y);
    },
    [](const auto& x, const auto& y) {
      using std::floor;
      return floor(3.0 * x) * y + floor(x - 2.7 * y) * x;
    },
    [](const auto& x, const auto& y) {
      using std::atan2, std::hypot, std::pow;
      return atan2(x, -y) + atan2(2.0, x) + hypot(x, y) + hypot(1.0, y) -
             pow(x, y) * pow(2.0, x) * pow(y, 1.7);
    },
    [](const auto& x, const auto& y) {
      using std::min, std::max, std::sqrt, avi::select;
      return min(x, y) * max(x, 1.0 + y) + min(2.0 * x, x * x) +
             select(x < y && !(1.0 >= y), sqrt(y - x), x * y) - select(y <= 1.0 || x > 2.0, y, 3.0 * x);
    },
    [](const auto& x, const auto& y) { return 2.0 + x - y + 0.5 * x - (1.0 - y) * x + x * (x * y - y); },
    [](const auto& x, const auto& y) { return x / y - 3.0 / x + x * y * x / 7.0 - (-y) / (x + y); },
    [](const auto& x, const auto& y) {
      using std::sqrt;
      return sqrt(x * y) + 2.0 / sqrt(x) - x / sqrt(y);
    },
    [](const auto& x, const auto& y) {
      using avi::power;
      return power(x, 0.3) * power(y, -1.7) + power(y, 1.0) - power(x, 0.0);
    }};
