#pragma once
#include "avi/autodiff/recording.hpp"

#include <memory>

/// @file
/// A transformed problem as programs: every Hamiltonian with every monitor is of one type.

namespace avi::detail {

/// The programs of \f$\bar H = g\,(H - H_0)\f$, made once and shared by all methods that run on them.
struct Formulas {
  Program forces;      ///< \f$\partial\bar H/\partial q\f$.
  Program velocities;  ///< \f$\partial\bar H/\partial p\f$.
  Program rate;        ///< g; not used where `unit`.
  bool unit = false;   ///< g = 1.
  Eigen::Index n = 0;  ///< Degrees of freedom.

  /// Of \f$\bar H\f$ and g as nodes of one graph of (q, p).
  /// @param energy node of H @param supplied those of its gradient, where H has one of its own
  static std::shared_ptr<const Formulas> of(const ExpressionGraph& graph, int transformed, int rate,
                                            int energy = -1, const std::vector<int>& supplied = {}) {
    const int n = graph.inputs() / 2;
    const Recording recording(graph, transformed, energy, supplied);
    return std::make_shared<const Formulas>(Formulas{.forces = recording.gradient(0, n),
                                                     .velocities = recording.gradient(n, n),
                                                     .rate = Recording(graph, rate).value(),
                                                     .unit = graph.is(rate, 1.0),
                                                     .n = n});
  }
};

}  // namespace avi::detail
