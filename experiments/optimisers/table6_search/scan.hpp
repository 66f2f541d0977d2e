#pragma once
#include "optimisers/table6_search/modes.hpp"

#include <array>
#include <limits>
#include <vector>

/// @file
/// Which settings of HTVI give a row of nine iteration counts.
///
/// In the variables z = t^(p/2) (x - 1) and S = t^(p/2) R / sqrt(C) a step of eta = h p^2 / p_ring is
/// autonomous,
///
///   S' = S - u grad f(z),  z' = z + u S',  z+ = z' e^(eta/2),  S+ = S' e^(-eta/2),  u = sqrt(C) eta,
///
/// up to terms of the order eta / p and the slow change of eta by e^(-h k). Counts depend on u at the fifth
/// digit, as phases of many turns do, and on eta at fixed u at the third. So a grid is fine in u, and one
/// trajectory serves several eta: what depends on eta beside its small part in the motion is the scale of f =
/// t^(-2p) f(z) and of its gradient, t^(-3p/2) grad f(z).

namespace experiment::table6_search {

constexpr int cells = 9;
using Counts = std::array<long, cells>;  ///< Updates until delta = 1e-2, ..., 1e-10.

/// The ranges of the search: ratios are steps of geometric grids.
struct Ranges {
  double u_low = 2e-4, u_high = 1.25e-3, u_ratio = 1.00001;
  double eta_low = 0.0038, eta_high = 0.0066;
  static constexpr double eta_ratio = 1.001;
  static constexpr int etas = 16;  ///< Values of eta that one trajectory serves.
};

/// The outcome of a run.
struct Variant {
  const char* name;
  Form form = Form::type_2;
  Test test = Test::both;
  double away = 4.0;      ///< Every entry of x_0 - 1.
  double momentum = 1.0;  ///< Every entry of r_0 t_0^(-p): of r_0 with t_0 = 1.
  bool loop = false;  ///< Temporal looping: t returns to 1 after some time, position and velocity are kept.
  double u_by = 1.0;  ///< Factor on the range of u: what oscillates more slowly is stable at a larger step.
};

/// A point of the grid and how many of the first cells it hits within `slack`.
struct Hit {
  double u = 0.0, eta = 0.0;
  int leading = 0;
};

struct Scan {
  double points = 0;
  std::array<double, cells + 1> with{};  ///< Points by how many leading cells they hit.
  Hit best;                              ///< The first of those with most.
};

constexpr long slack = 3;
constexpr double h = 2e-6;  ///< As printed.

/// Scans the ranges for some rows at once.
std::vector<Scan> scan(const Spectrum& of, const Variant& variant, const Ranges& ranges,
                       const std::vector<Counts>& wanted);

/// The counts of one run in the variables of the paper, with p and p_ring = p^2 h / eta: no scaling, no grid.
/// A cell that is not reached within `cap` updates has 0. Where t passes `t_turn`, it is set to 1.
Counts exact_counts(const Spectrum& of, const Variant& variant, double p, double u, double eta,
                    long cap = 12000, double t_turn = std::numeric_limits<double>::infinity());

}  // namespace experiment::table6_search
