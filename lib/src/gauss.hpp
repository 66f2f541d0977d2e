#pragma once
#include "avi/core/step.hpp"
#include "formulas.hpp"

#include <memory>

/// @file
/// Gauss collocation of recorded formulas, whatever processor it is compiled for.

namespace avi::detail {

/// When the sweeps of a step have solved it.
struct SweepBounds {
  double tolerance = 6.25e-19;  ///< See SweepSettings.
  int most = 100;               ///< After so many sweeps a step ends as Outcome::not_converged.
  /// From this step on programs run as machine code, which is made then unless another run of the same
  /// formulas has made it: some 100 ns an operation, and memory. The bits are the same.
  int code_from_step = 20;
};

/// The steps of one orbit by Gauss collocation: see Collocation. Numbers are passed by address and nothing of
/// another library is, so that what is behind may be compiled for another processor than what is before.
class GaussSteps {
 public:
  virtual ~GaussSteps() = default;
  GaussSteps& operator=(const GaussSteps&) = delete;  ///< See clone().

  /// Advances z = (q, p), 2n numbers, and t by the fictive step h; leaves both unchanged unless the step ends
  /// as ok.
  virtual StepReport step(double* z, double& t, double h) = 0;
  /// The collocation polynomial of the last step at its fraction c.
  virtual void polynomial(double c, double* z, double& t) const = 0;
  /// How well the last step is resolved, entry by entry of (q, p): see Collocation::tail().
  virtual void tail(double* z) const = 0;
  /// Another one with the memory of the last step: it goes on with the same bits.
  [[nodiscard]] virtual std::unique_ptr<GaussSteps> clone() const = 0;

 protected:
  GaussSteps() = default;
  GaussSteps(const GaussSteps&) = default;
};

/// Of the given order, 2, 4, ... 16. @throws std::invalid_argument for another order, or an improper bound.
std::unique_ptr<GaussSteps> gauss_steps(std::shared_ptr<const Formulas> formulas, int order,
                                        SweepBounds bounds = {});

}  // namespace avi::detail
