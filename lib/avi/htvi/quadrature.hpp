#pragma once
#include <string>
#include <vector>

/// @file
/// Quadrature rules on [0, 1]: nodes c_i, weights b_i and order s.

namespace avi {

/// A quadrature rule: \f$\sum_i b_i f(c_i)\f$ is the integral of f over [0, 1], exactly for polynomials of
/// degree < order.
struct Quadrature {
  std::string name;             ///< Entry of the column `quadrature` in data files.
  int order;                    ///< s.
  std::vector<double> nodes;    ///< c_i.
  std::vector<double> weights;  ///< b_i, as many as nodes, with sum 1.
};

/// @name Quadrature rules
/// @{

/// One node at 0, order 1: the rule of the paper's symplectic Euler-B (Section 3.3).
Quadrature rectangle_left();
/// One node at 1/2, order 2.
Quadrature midpoint();
/// Nodes at both ends, order 2.
Quadrature trapezoid();
/// Nodes at both ends and the middle, order 4: the rule of HTVI4 in Tables 1 and 2 of the paper.
Quadrature simpson();
/// Five equidistant nodes, order 6.
Quadrature boole();
/// m-point Gauss, order 2m. @throws std::invalid_argument unless 1 <= m <= 16.
Quadrature gauss(int m);
/// m-point Lobatto (both ends are nodes), order 2m - 2. @throws std::invalid_argument unless 2 <= m <= 16.
Quadrature lobatto(int m);
/// m-point left Radau (0 is a node), order 2m - 1. @throws std::invalid_argument unless 1 <= m <= 16.
Quadrature radau(int m);
/// @}

/// Checks a rule. @throws std::invalid_argument for a rule without nodes, with unequal numbers of nodes and
/// weights, with a node outside [0, 1], or with too high an order: it must integrate all powers below its
/// order exactly, to rounding.
void validate(const Quadrature& rule);

}  // namespace avi
