#pragma once
#include <string>
#include <vector>

/// @file
/// Quadrature rules on [0, 1]: nodes c_i, weights b_i and order s.

namespace avi {

/// \f$\sum_i b_i f(c_i)\f$ is the integral of f over [0, 1], exactly so for polynomials of degree < order.
struct Quadrature {
  std::string name;             ///< The column `quadrature` of data files.
  int order;                    ///< s.
  std::vector<double> nodes;    ///< c_i.
  std::vector<double> weights;  ///< b_i, as many as nodes, with sum 1.
};

/// @name Rules by name
/// @{

/// f(0), order 1: the rule of the paper's symplectic Euler-B (Section 3.3).
Quadrature rectangle_left();
/// f(1/2), order 2.
Quadrature midpoint();
/// Both ends, order 2.
Quadrature trapezoid();
/// Both ends and the middle, order 4: the rule of HTVI4 in Tables 1 and 2.
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

/// Checks a rule. @throws std::invalid_argument for one without nodes, with unequal counts, with a node that
/// is not in [0, 1], or with an order that it has not: it must integrate the powers below it to rounding.
void validate(const Quadrature& rule);

}  // namespace avi
