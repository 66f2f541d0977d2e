#pragma once
#include "gauss.hpp"

/// @file
/// The builds of the Gauss stepper that a library has.

namespace avi::detail {

/// A build of gauss_steps().
using MakeGaussSteps = std::unique_ptr<GaussSteps>(std::shared_ptr<const Formulas> formulas, int order,
                                                   SweepBounds bounds);

MakeGaussSteps gauss_steps_portable;  ///< For any processor of this kind.
MakeGaussSteps gauss_steps_v3;        ///< With AVX2, where the library has it.
MakeGaussSteps gauss_steps_v4;        ///< With AVX-512, where the library has it.

}  // namespace avi::detail
