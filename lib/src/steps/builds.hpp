#pragma once
#include "avi/optim/minimiser.hpp"
#include "src/steps/steppers.hpp"

#include <span>

/// @file
/// The builds of the steppers and of the minimiser, one for each set of instructions of the library.

namespace avi::detail {

/// The type of gauss_steps() for one set of instructions.
using MakeGaussSteps = std::unique_ptr<Stepper>(std::shared_ptr<const Formulas> formulas, int order,
                                                SweepSettings sweeps);

MakeGaussSteps gauss_steps_portable;  ///< Build for any processor of this kind.
MakeGaussSteps gauss_steps_v3;        ///< Build with AVX2, where the library has it.
MakeGaussSteps gauss_steps_v4;        ///< Build with AVX-512, where the library has it.

/// The type of splitting_steps() for one set of instructions.
using MakeSplittingSteps = std::unique_ptr<Stepper>(std::shared_ptr<const Formulas> formulas);

MakeSplittingSteps splitting_steps_portable;  ///< Build for any processor of this kind.
MakeSplittingSteps splitting_steps_v3;        ///< Build with AVX2.
MakeSplittingSteps splitting_steps_v4;        ///< Build with AVX-512.

/// The type of minimise_by_calls() for one set of instructions.
using MinimiseByCalls = MinimiserEnd(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options);

MinimiseByCalls minimise_portable;  ///< Build for any processor of this kind.
MinimiseByCalls minimise_v3;        ///< Build with AVX2.
MinimiseByCalls minimise_v4;        ///< Build with AVX-512.

/// One build, by the functions that lead into it.
struct Build {
  const char* name;               ///< Name in AVI_INSTRUCTIONS.
  MakeGaussSteps* make;           ///< Gauss collocation.
  MakeSplittingSteps* splitting;  ///< Splitting.
  MinimiseByCalls* minimise;      ///< Minimiser.
  bool runs;                      ///< Whether it runs on this processor.
};
/// All builds of this library, the fastest first.
std::span<const Build> builds();

/// The fastest build that runs here, or that of this name. @throws std::invalid_argument where it does not
/// run here, or there is none of this name
const Build& build_of(const char* name);

}  // namespace avi::detail
