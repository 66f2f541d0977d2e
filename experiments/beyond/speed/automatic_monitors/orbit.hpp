#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

/// @file
/// An orbit: H as a formula, and a start.

namespace experiment {

using avi::Formula, avi::State, avi::dynamic, avi::require_dimension;

/// H as a formula and the start of an orbit in vectors whose size is known at run time: what is found out
/// about the orbit is then compiled once for all H.
struct Orbit {
  Formula energy;        ///< H.
  State<dynamic> start;  ///< With finite H.

  /// Records H. @throws std::invalid_argument where q and p are of different size or empty, or H is not
  /// finite at the start.
  template <class H, int n>
  Orbit(const H& hamiltonian, const State<n>& from)
      : energy((require_dimension(from), Formula::of_phase<n>(hamiltonian, from.q.size()))),
        start{.q = from.q, .p = from.p, .t = from.t} {
    check();
  }

  /// Of H that is recorded already. @throws std::invalid_argument where H is not finite at the start.
  Orbit(Formula hamiltonian, State<dynamic> from) : energy(std::move(hamiltonian)), start(std::move(from)) {
    check();
  }

  [[nodiscard]] double energy_at_start() const { return energy(start.q, start.p); }  ///< H_0.

 private:
  void check() const {
    if (!start.finite() || !std::isfinite(energy_at_start()))
      throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
  }
};

}  // namespace experiment
