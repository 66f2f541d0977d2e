#pragma once
#include <cmath>
#include <tuple>

/// The elementary functions of every scalar, in formulas of x, y > 0 that are generic in it.
inline const auto elementary = std::tuple{[](const auto& x, const auto& y) {
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
                                          }};
