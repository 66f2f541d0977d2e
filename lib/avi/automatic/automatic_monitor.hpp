#pragma once
#include "avi/automatic/tour.hpp"

#include <stdexcept>
#include <string>

/// @file
/// A monitor found from H alone.

namespace avi {

namespace detail {

/// The candidate monitors of H as formulas of (q, p); their constants come from a tour along the orbit.
class Monitors {
 public:
  /// For this orbit. @throws std::invalid_argument where it has no time scale, or speeds have no measure
  explicit Monitors(const Orbit& orbit)
      : energy_at_start_(orbit.energy_at_start()), curvature_(orbit), tour_(orbit, curvature_) {
    if (!(tour_.frequency > 0.0))
      throw std::invalid_argument(
          "The second derivatives of H with respect to q are zero or not finite along the orbit, so "
          "that it has no time scale; give a monitor of your own, or none.");
  }

  /// A monitor with its name, and H times it: what a method has to work through.
  struct Entry {
    std::string name;
    PhaseFunction monitor, transformed;
  };

  /// \f$g = \big(\sqrt{n_0 + (\bar\omega/16)^4} + (\bar\omega/8)^2\big)^{-1/2}\f$.
  Entry curvature() {
    const double low = tour_.frequency / 8.0;
    return entry("curvature", power(plus(power(smooth(0.0625), 0.5), low * low), -0.5));
  }
  /// \f$g = \big((n_0 + (\bar\omega/4)^4)^{1/4} + \bar\omega\big)^{-1}\f$: below one over the mean frequency.
  Entry gentle() { return entry("gentle", power(plus(power(smooth(0.25), 0.25), tour_.frequency), -1.0)); }
  /// \f$g = (1 + S/\bar S)^{-1/2}\f$ with the squared speed S in phase space and its mean.
  Entry speed() {
    const int speed = curvature_.scaled(1.0 / tour_.squared_speed, curvature_.squared_speed(tour_.frequency));
    return entry("speed", power(plus(speed, 1.0), -0.5));
  }
  /// \f$g = (\bar T + \frac12(H + H_0) - H(q, 0))^{-\alpha}\f$ with the mean kinetic energy. On the orbit
  /// H(q, p) - H(q, 0) could stand there as well; the half makes \f$\bar H_{qp}\f$ zero, see \ref monitors.
  Entry energy(const std::string& name, double exponent) {
    const int half = curvature_.scaled(0.5, curvature_.energy);
    const int moving = curvature_.graph.binary(Operation::subtract, half, curvature_.energy_at_rest());
    const int lively = plus(moving, 0.5 * energy_at_start_ + tour_.kinetic);
    return entry(name, power(lively, -exponent));
  }
  /// 1, no monitor.
  Entry fixed() { return entry("fixed", curvature_.graph.constant(1.0)); }
  [[nodiscard]] const Tour& tour() const { return tour_; }  ///< The scales.

 private:
  int plus(int a, double b) { return curvature_.plus(a, curvature_.graph.constant(b)); }
  int power(int a, double exponent) { return curvature_.graph.power(a, exponent); }
  Entry entry(const std::string& name, int g) {
    return {name,
            {curvature_.graph, g},
            {curvature_.graph, curvature_.times(g, plus(curvature_.energy, -energy_at_start_))}};
  }
  int smooth(double share) { return plus(tour_.n0, std::pow(share * tour_.frequency, 4)); }

  double energy_at_start_;
  Curvature curvature_;
  Tour tour_;
};

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
template <class H, int n>
PhaseFunction automatic_monitor(const H& hamiltonian, const State<n>& start) {
  return detail::Monitors({hamiltonian, start}).curvature().monitor;
}

}  // namespace avi
