#pragma once
#include "avi/core/state.hpp"

#include <algorithm>
#include <cmath>

/// @file
/// The same state, its dimension known to the compiler and only at run time.

/// A copy whose dimension is known at run time.
template <int n>
avi::State<avi::dynamic> run_time(const avi::State<n>& z) {
  return {.q = z.q, .p = z.p, .t = z.t};
}

/// How far two states are apart: q and t absolutely, p relatively.
template <int n>
double gap(const avi::State<n>& a, const avi::State<avi::dynamic>& b) {
  return std::max({(a.q - b.q).norm(), (a.p - b.p).norm() / a.p.norm(), std::abs(a.t - b.t)});
}
