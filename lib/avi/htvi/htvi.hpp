#pragma once
#include "avi/htvi/generating_map.hpp"

#include <utility>

/// @file
/// The ways to make an HTVI.

namespace avi {

/// Type II HTVI of Taylor order r and the given rule (Section 2.2 of the paper); its order is at least
/// min(r + 1, rule.order) (Theorem 2.1). avi::superconvergent is the construction with the best order;
/// avi::printed and avi::authors are the paper's.
/// @param problem from poincare() or time_dependent(); copied @param rule such as gauss(4)
/// @param solver tolerance and cap of the implicit equation
/// @throws std::invalid_argument for an improper rule or solver setting.
template <int r, Construction construction = superconvergent, class Problem>
Htvi<Generating::type2, Problem, r, construction> type2(const Problem& problem, Quadrature rule,
                                                        SolverSettings solver = {}) {
  return Htvi<Generating::type2, Problem, r, construction>(problem, std::move(rule), solver);
}

/// Type III HTVI of Taylor order r and the given rule; as type2() otherwise.
/// @throws std::invalid_argument for an improper rule or solver setting.
template <int r, Construction construction = superconvergent, class Problem>
Htvi<Generating::type3, Problem, r, construction> type3(const Problem& problem, Quadrature rule,
                                                        SolverSettings solver = {}) {
  return Htvi<Generating::type3, Problem, r, construction>(problem, std::move(rule), solver);
}

/// HTVI whose Taylor order, in [0, 15], is chosen at run time: one compiled method for every order.
/// @throws std::invalid_argument for an order out of range, an improper rule or solver setting.
template <Generating type, Construction construction = superconvergent, class Problem>
Htvi<type, Problem, dynamic, construction> htvi_of_order(int order, const Problem& problem, Quadrature rule,
                                                         SolverSettings solver = {}) {
  return Htvi<type, Problem, dynamic, construction>(problem, std::move(rule), solver, order);
}

}  // namespace avi
