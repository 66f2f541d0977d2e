#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/core/state.hpp"

#include <vector>

/// @file
/// A monitor found from H alone.

namespace avi {

namespace detail {
/// automatic_monitor() of an orbit through (q, p).
Formula automatic_monitor(const Formula& hamiltonian, const std::vector<double>& q,
                          const std::vector<double>& p);
}  // namespace detail

/// A monitor of H for orbits like the one through `start`, with nothing to choose. With \f$n_0\f$ the sum
/// over the terms of H of their squared second derivatives (of each pair of bodies; frequency to the power 4,
/// see detail::Curvature) and \f$\bar\omega\f$ the mean of \f$n_0^{1/4}\f$ in time along the first part of
/// the orbit, \f[ g(q, p) = \Big(\sqrt{n_0 + (\bar\omega/16)^4} + (\bar\omega/8)^2\Big)^{-1/2}. \f] On
/// Kepler's problem it is \f$|q|^{3/2}\f$ but for a factor and the bound. \f$0 < g < 8/\bar\omega\f$ wherever
/// H has finite derivatives. It is invariant under rotations, translations, units and masses, and linear
/// changes of coordinates, as far as they leave the terms of H together. One step of a method with h = 1 is
/// about one radian of the fastest motion.
///
/// H is called once, with a scalar that records what is done to it; a branch on values does not compile.
/// @throws std::invalid_argument where H is not finite at the start, \f$H_{pp}\f$ not positive definite
/// there, or \f$n_0\f$ zero or not finite all along the orbit.
template <int n>
Formula automatic_monitor(const Formula& hamiltonian, const State<n>& start) {
  require_dimension(start);
  return detail::automatic_monitor(hamiltonian, {start.q.data(), start.q.data() + start.q.size()},
                                   {start.p.data(), start.p.data() + start.p.size()});
}
/// The same of an H that is not recorded yet.
template <class H, int n>
Formula automatic_monitor(const H& hamiltonian, const State<n>& start) {
  require_dimension(start);
  return automatic_monitor(Formula::of_phase<n>(hamiltonian, start.q.size()), start);
}

}  // namespace avi
