#pragma once
#include "avi/htvi/generating_map.hpp"

#include <utility>

/// @file
/// The ways to make an HTVI.

namespace avi {

/// Type II HTVI of Taylor order r and the given rule; its order is at least min(r + 1, rule.order).
template <int r, Construction construction = superconvergent, class Problem>
Htvi<Generating::type2, Problem, r, construction> type2(const Problem& problem, Quadrature rule,
                                                        SolverSettings solver = {}) {
  return Htvi<Generating::type2, Problem, r, construction>(problem, std::move(rule), solver);
}

/// Type III HTVI of Taylor order r and the given rule; its order is at least min(r + 1, rule.order).
template <int r, Construction construction = superconvergent, class Problem>
Htvi<Generating::type3, Problem, r, construction> type3(const Problem& problem, Quadrature rule,
                                                        SolverSettings solver = {}) {
  return Htvi<Generating::type3, Problem, r, construction>(problem, std::move(rule), solver);
}

/// HTVI whose Taylor order, in [0, 15], is chosen at run time: one compiled method for every order.
/// @throws std::invalid_argument for an order out of range.
template <Generating type, Construction construction = superconvergent, class Problem>
Htvi<type, Problem, dynamic, construction> htvi_of_order(int order, const Problem& problem, Quadrature rule,
                                                         SolverSettings solver = {}) {
  return Htvi<type, Problem, dynamic, construction>(problem, std::move(rule), solver, order);
}

}  // namespace avi
