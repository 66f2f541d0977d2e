#pragma once

/// @file
/// What is chosen about a generating map besides its discrete Hamiltonian.

namespace avi {

/// Which generating function a step comes from.
enum class Generating {
  type2,  ///< H_d^+(q_0, p_1), the discrete right Hamiltonian
  type3   ///< H_d^-(q_1, p_0), the discrete left Hamiltonian
};

/// How far the implicit equation of a step is solved.
struct SolverSettings {
  double tolerance = 8.0;  ///< Residual accepted, in units of machine epsilon times the size of the unknown.
  int max_iterations = 50;
};

}  // namespace avi
