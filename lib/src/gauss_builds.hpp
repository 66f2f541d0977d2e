#pragma once
#include "avi/optim/minimiser.hpp"
#include "gauss.hpp"

#include <span>

/// @file
/// The builds of the steppers and of the minimiser that a library has.

namespace avi::detail {

/// gauss_steps() for one set of instructions.
using MakeGaussSteps = std::unique_ptr<Stepper>(std::shared_ptr<const Formulas> formulas, int order,
                                                SweepSettings sweeps);

MakeGaussSteps gauss_steps_portable;  ///< For any processor of this kind.
MakeGaussSteps gauss_steps_v3;        ///< With AVX2, where the library has it.
MakeGaussSteps gauss_steps_v4;        ///< With AVX-512, where the library has it.

/// splitting_steps() for one set of instructions.
using MakeSplittingSteps = std::unique_ptr<Stepper>(std::shared_ptr<const Formulas> formulas);

MakeSplittingSteps splitting_steps_portable;  ///< As above.
MakeSplittingSteps splitting_steps_v3;        ///< As above.
MakeSplittingSteps splitting_steps_v4;        ///< As above.

/// minimise_by_calls() for one set of instructions.
using MinimiseByCalls = MinimiserEnd(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options);

MinimiseByCalls minimise_portable;  ///< As above.
MinimiseByCalls minimise_v3;        ///< As above.
MinimiseByCalls minimise_v4;        ///< As above.

/// One build, by its doors.
struct GaussBuild {
  const char* name;               ///< Its name in AVI_INSTRUCTIONS.
  MakeGaussSteps* make;           ///< Gauss collocation.
  MakeSplittingSteps* splitting;  ///< Splitting.
  MinimiseByCalls* minimise;      ///< Minimiser.
  bool runs;                      ///< On this processor.
};
/// All of this library, the fastest first.
std::span<const GaussBuild> gauss_builds();

/// The fastest one that runs here, or that of this name. @throws std::invalid_argument where it does not run
/// here or there is none of this name.
const GaussBuild& gauss_build(const char* name);

}  // namespace avi::detail
