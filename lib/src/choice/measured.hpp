#pragma once
#include "src/choice/sketch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// @file
/// Measurements of the monitor of an orbit along its sketch.

namespace avi::detail {

/// The potential V, see Candidate, along a sketch.
struct Resting {
  std::vector<double> energy;  ///< V at each sample.
  std::vector<double> forces;  ///< \f$-\partial V/\partial q\f$ at each sample, n numbers each.
};

/// Returns the largest derivative of H by each entry along the sketch. It is at least 1e-14 of the largest of
/// its kind, masses taken out, since less is rounding.
VectorX strengths(const Sketch& sketch, const VectorX& metric);

/// The rate of change \f$\ell\f$ of a monitor along a sketch.
struct Measured {
  std::vector<double> lively;  ///< Value at each sample.
  /// Value of a rate near poles and absolute value of its time derivative: at the samples, and midway between
  /// each and the next, which may be far away where the motion is free.
  std::vector<std::array<double, 2>> changes = {};
  double steepest = 0.0;  ///< Its largest relative derivative, over the strength of the entry.
  double shaken = 0.0;    ///< Time integral of that by one entry, over the range of the other of its pair.

  /// Takes in a derivative of the rate at the last sample.
  void add_slope(double slope, double strength) {
    steepest = std::max(steepest, std::abs(slope) / (std::abs(lively.back()) * strength));
  }
};

/// Measures the rate that energy monitors follow.
Measured measure(const Sketch& sketch, const Resting& resting, double energy_at_start, double kinetic,
                 const VectorX& strength);
/// Measures the rate at a node of a graph.
Measured measure(const Sketch& sketch, const ExpressionGraph& graph, int node, const VectorX& strength,
                 bool with_changes = false);

/// The rate \f$(\sqrt{w_0} + \sqrt\phi)^2\f$ made of a frequency \f$\phi\f$ near poles and a constant one.
double with_constant(double near, double constant);
/// Largest relative change of that rate per unit of its fictive time.
double fastest_change(const Measured& near, double constant);
/// Returns the constant frequency that, beside the frequency near poles, gives the fewest steps if the
/// longest one has a fixed length in radians. A monitor that changes as \f$1/(\tau - \tau_0)\f$ counts as a
/// frequency, too.
double background(const Sketch& sketch, const Measured& near);

}  // namespace avi::detail
