#pragma once
#include "beyond/speed/automatic_monitors/orbit_scales.hpp"

/// @file
/// A monitor found from H alone.

namespace experiment {

/// A monitor of H for orbits like the one through `start`, with nothing to choose. With \f$n_0\f$ the sum
/// over the terms of H of their squared second derivatives (of each pair of bodies; frequency to the power 4,
/// see Curvature) and \f$\bar\omega\f$ the mean of \f$n_0^{1/4}\f$ in time along the first part of
/// the orbit, \f[ g(q, p) = \Big(\sqrt{n_0 + (\bar\omega/16)^4} + (\bar\omega/8)^2\Big)^{-1/2}. \f] On
/// Kepler's problem it is \f$|q|^{3/2}\f$ but for a factor and the bound. \f$0 < g < 8/\bar\omega\f$ wherever
/// H has finite derivatives. It is invariant under rotations, translations, units and masses, and linear
/// changes of coordinates, as far as they leave the terms of H together. One step of a method with h = 1 is
/// about one radian of the fastest motion.
///
/// H is called once, with a scalar that records what is done to it; a branch on values does not compile.
/// @throws std::invalid_argument where H is not finite at the start, \f$H_{pp}\f$ not positive definite
/// there, or \f$n_0\f$ zero or not finite all along the orbit.
template <class H, int n>
Formula automatic_monitor(const H& hamiltonian, const State<n>& start) {
  const Orbit orbit(hamiltonian, start);
  Curvature curvature(orbit);
  const OrbitScales scales(orbit, curvature);
  const int monitor = curvature_monitor(curvature, scales);
  return {curvature.graph, monitor};
}

}  // namespace experiment
