#pragma once
#include "avi/bregman/bregman_hamiltonian.hpp"

#include <cmath>

// Splittings of the Bregman Hamiltonian on extended phase space, r^t included: as printed, and symplectic.

namespace experiment {

/// One step as the paper prints it (Section 4.4, table "Updates for Direct and Adaptive Approaches with
/// Splitting of the Hamiltonian").
///
/// Its half steps of r^t use r at one time and t at another, so that the map is no composition of flows: its
/// (q, r) block is symplectic, the whole is not (the defect is O(h^3)). Kept as the control of the tests.
template <avi::Objective F>
void splitting_printed_step(const avi::BregmanFamily& family, const F& f, double h, avi::ExtendedPoint& z) {
  const double p = family.p, p_ring = family.p_ring, s = family.s();
  avi::VectorX gradient(z.q.size());
  const auto half_r_t = [&](double value) {
    if (family.is_direct()) {
      z.r_t -= 0.5 * h *
               (0.5 * family.kinetic_rate(z.t) * avi::dot(z.r, z.r) + family.potential_rate(z.t) * value);
      return;
    }
    const double theta =
        p_ring / (p_ring - p) *
        ((0.5 * p * p * p / p_ring + 0.5 * p) * std::pow(z.t, -p - 1.0) * avi::dot(z.r, z.r) +
         (p - 2.0 * p * p * p / p_ring) * std::pow(z.t, 2.0 * p - 1.0) * family.C * value);
    z.r_t = (z.r_t + theta) * std::exp((1.0 - p / p_ring) * 0.5 * h * std::pow(z.t, -s)) - theta;
  };
  z.t = family.exact_clock(z.t, 0.5 * h);
  double value = f(z.q, gradient);
  half_r_t(value);
  z.r -= (0.5 * h * family.potential(z.t)) * gradient;
  z.q += (h * family.kinetic(z.t)) * z.r;
  value = f(z.q, gradient);
  z.r -= (0.5 * h * family.potential(z.t)) * gradient;
  half_r_t(value);
  z.t = family.exact_clock(z.t, 0.5 * h);
}

// The three flows, each exact.

/// Flow of kinetic(t) |r|^2 / 2.
inline void kinetic_flow(const avi::BregmanFamily& family, double h, avi::ExtendedPoint& z) {
  z.q += (h * family.kinetic(z.t)) * z.r;
  z.r_t -= 0.5 * h * family.kinetic_rate(z.t) * avi::dot(z.r, z.r);
}

/// Flow of potential(t) f(q).
template <avi::Objective F>
void potential_flow(const avi::BregmanFamily& family, const F& f, double h, avi::ExtendedPoint& z) {
  avi::VectorX gradient(z.q.size());
  const double value = f(z.q, gradient);
  z.r -= (h * family.potential(z.t)) * gradient;
  z.r_t -= h * family.potential_rate(z.t) * value;
}

/// Flow of monitor(t) r^t: t^s advances by h, and monitor(t) r^t stays.
inline void clock_flow(const avi::BregmanFamily& family, double h, avi::ExtendedPoint& z) {
  const double before = family.monitor(z.t);
  z.t = family.exact_clock(z.t, h);
  z.r_t *= before / family.monitor(z.t);
}

/// Their symmetric composition: clock, potential, kinetic, potential, clock. A composition of exact flows, so
/// symplectic on extended phase space; order 2; the same q, r and t as the printed splitting.
template <avi::Objective F>
void three_flow_step(const avi::BregmanFamily& family, const F& f, double h, avi::ExtendedPoint& z) {
  clock_flow(family, 0.5 * h, z);
  potential_flow(family, f, 0.5 * h, z);
  kinetic_flow(family, h, z);
  potential_flow(family, f, 0.5 * h, z);
  clock_flow(family, 0.5 * h, z);
}

}  // namespace experiment
