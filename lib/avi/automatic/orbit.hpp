#pragma once
#include "avi/automatic/phase_function.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <stdexcept>

/// @file
/// A Hamiltonian and a start, of whatever type and dimension.

namespace avi::detail {

/// H as a formula and the start of an orbit in vectors whose size is known at run time: what is found out
/// about the orbit is then compiled once for all H.
struct Orbit {
  PhaseFunction energy;  ///< H.
  State<dynamic> start;  ///< With finite H.

  /// Records H. @throws std::invalid_argument where q and p are of different size or empty, or H is not
  /// finite at the start.
  template <class H, int n>
  Orbit(const H& hamiltonian, const State<n>& from)
      : energy((require_dimension(from), phase_function<n>(hamiltonian, from.q.size()))), start{.q = from.q,
                                                                                                .p = from.p,
                                                                                                .t = from.t} {
    if (!start.finite() || !std::isfinite(energy_at_start()))
      throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
  }

  [[nodiscard]] double energy_at_start() const { return energy(start.q, start.p); }  ///< H_0.
};

}  // namespace avi::detail
