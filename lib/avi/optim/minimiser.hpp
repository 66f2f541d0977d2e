#pragma once
#include "avi/optim/minimise_options.hpp"
#include "avi/optim/run_updates.hpp"

#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

/// @file
/// Minimiser: L-BFGS and nonlinear conjugate gradients with a line search by interpolation, the method of
/// avi::minimise().

namespace avi {

namespace detail {

/// The calls that the compiled minimiser makes to its caller. The caller owns the vectors, three positions
/// and three gradients, which are known by their numbers 0, 1, 2. Eigen vectors are not passed, because the
/// library may be compiled for another instruction set than the caller, with another memory layout.
class MinimiserCalls {
 public:
  /// The state of a run.
  struct Place {
    int x, g;          ///< Number of the position vector and of the gradient vector.
    double value;      ///< f there.
    double norm;       ///< 2-norm of the gradient.
    long iterations;   ///< Iterations made.
    long evaluations;  ///< Evaluations of the gradient.
    bool exact;        ///< See Progress.
  };

  virtual ~MinimiserCalls() = default;
  virtual double* position(int x) = 0;  ///< The n entries of position x.
  virtual double* gradient(int g) = 0;  ///< The n entries of gradient g.
  /// Evaluates f at position x and stores the gradient in g. @return f, and the number of entries to which f
  /// set the gradient; it is resized to n again
  virtual std::pair<double, Eigen::Index> evaluate(int x, int g) = 0;
  /// Calls the callback. @return false to stop the run
  virtual bool report(const Place& place) = 0;
};

/// The outcome and the last point of a run of the minimiser.
struct MinimiserEnd {
  Outcome outcome;              ///< How the run ended.
  MinimiserCalls::Place place;  ///< The last valid point that was evaluated.
  std::string message;          ///< See Minimisation.
};

/// Runs the minimisation from position 0, a vector of n entries.
MinimiserEnd minimise_by_calls(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options);

}  // namespace detail

/// One run of L-BFGS (memory m > 0) or of a nonlinear conjugate gradient method (m = 0), \f[ x_+ = x + \alpha
/// d, \qquad d = -H \nabla f \quad\text{or}\quad d_+ = \beta d - \nabla f(x_+). \f] Its line search by
/// interpolation takes one evaluation per iteration where f is nearly quadratic along the line. H is the
/// L-BFGS matrix of the last m pairs; beta is that of Dai and Kou (2013), with restarts.
///
/// In terms of Bregman dynamics the second form is a heavy ball: the order-0 HTVI (bregman/bregman_htvi.hpp),
/// with a clock that depends on the state and is frozen during a step. \f$H^{-1}\f$ corresponds to a variable
/// mass matrix.
///
/// **Line interpolation.** One trial along d gives value and slope at two points of the line. If the values
/// confirm that f is quadratic between them (LineModel), the minimum on the line and the gradient there are
/// interpolated, so the iteration costs one evaluation. Otherwise the trial is accepted if it satisfies the
/// Wolfe conditions, and if not, the line is searched. An interpolated point that fails later is evaluated;
/// if f rose there, the run goes back to the best evaluated point.
///
/// Each operation on vectors takes one pass over memory. There are seven vectors, and 2 m + 1 more. The run
/// itself is in the compiled library; this class holds f and the vectors that f sees. For theory, the choice
/// of alpha and beta, and measurements, see @ref optimisation.
class Minimiser final : detail::MinimiserCalls {
 public:
  /// Value and gradient at a point.
  using Function = std::function<double(const VectorX&, VectorX&)>;

  /// Allocates the vectors of a run.
  /// @throws std::invalid_argument for options out of range, or an empty or non-finite x0.
  Minimiser(Function f, const VectorX& x0, const MinimiseOptions& options)
      : options_(options), f_(std::move(f)), n_(x0.size()) {
    options.validate();
    require(n_ > 0, "Size of x0", n_, "at least 1");
    require(std::isfinite(largest_entry(x0)), "Largest entry of x0", largest_entry(x0), "finite");
    x_[0] = x0;
    for (VectorX* v : {&x_[1], &x_[2], &g_[1], &g_[2]})
      v->setZero(n_);
    // NaN, so that an f that does not fill it is noticed
    g_[0].setConstant(n_, std::numeric_limits<double>::quiet_NaN());
  }

  /// Runs the minimisation. May be called only once. @throws std::logic_error for a further call.
  Minimisation run() {
    if (std::exchange(ran_, true))
      throw std::logic_error("The run of this Minimiser is over; another one takes another Minimiser.");
    detail::MinimiserEnd end = detail::minimise_by_calls(*this, n_, options_);
    const Place& at = end.place;
    return {.outcome = end.outcome,
            .iterations = at.iterations,
            .gradient_evaluations = at.evaluations,
            .function_evaluations = at.evaluations,
            .last = {.x = std::move(x_[at.x]),
                     .gradient = std::move(g_[at.g]),
                     .value = at.value,
                     .evaluated = true},
            .message = std::move(end.message)};
  }

 private:
  double* position(int x) override { return x_[x].data(); }
  double* gradient(int g) override { return g_[g].data(); }
  std::pair<double, Eigen::Index> evaluate(int x, int g) override {
    const double value = f_(x_[x], g_[g]);
    const Eigen::Index entries = g_[g].size();
    if (entries != n_) g_[g].setZero(n_);
    return {value, entries};
  }
  bool report(const Place& at) override {
    return !options_.callback || options_.callback({x_[at.x], g_[at.g], at.value, at.norm, at.iterations,
                                                    at.evaluations, at.exact});
  }

  MinimiseOptions options_;
  Function f_;
  Eigen::Index n_;
  std::array<VectorX, 3> x_, g_;
  bool ran_ = false;
};

}  // namespace avi
