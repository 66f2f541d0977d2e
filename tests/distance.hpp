#pragma once
#include "avi/core/state.hpp"

#include <cmath>

/// Euclidean distance of two states in (q, p, t).
template <int n>
double distance(const avi::State<n>& a, const avi::State<n>& b) {
  return std::sqrt((a.q - b.q).squaredNorm() + (a.p - b.p).squaredNorm() + (a.t - b.t) * (a.t - b.t));
}
