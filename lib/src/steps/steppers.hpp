#pragma once
#include "avi/collocation/gauss_rule.hpp"
#include "src/steps/formulas.hpp"
#include "src/steps/stepper.hpp"

#include <memory>

/// @file
/// The methods that run on recorded formulas, for any processor that they are compiled for.

namespace avi::detail {

/// Makes steps of Gauss collocation of order 2, 4, ... 16. @throws std::invalid_argument for another order,
/// or improper settings
std::unique_ptr<Stepper> gauss_steps(std::shared_ptr<const Formulas> formulas, int order,
                                     SweepSettings sweeps = {});

/// Makes steps of the explicit splitting of order 6, for formulas with g = 1 whose forces depend on q alone
/// and whose velocities are linear in p and free of q.
std::unique_ptr<Stepper> splitting_steps(std::shared_ptr<const Formulas> formulas);

}  // namespace avi::detail
