#pragma once
#include "avi/optim/minimise_options.hpp"
#include "avi/optim/run_updates.hpp"

#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

/// @file
/// L-BFGS and nonlinear conjugate gradients with a line search by interpolation: the method of
/// avi::minimise().

namespace avi {

namespace detail {

/// Calls that a run of the minimiser makes to its caller, who owns the vectors: three positions and three
/// gradients, known by their numbers 0, 1, 2. The library may be compiled for another processor than the
/// caller, where vectors of Eigen lie in memory otherwise.
class MinimiserCalls {
 public:
  /// Where a run stands.
  struct Place {
    int x, g;          ///< Numbers of the iterate and its gradient.
    double value;      ///< f there.
    double norm;       ///< 2-norm of the gradient.
    long iterations;   ///< Iterations made.
    long evaluations;  ///< Evaluations of the gradient.
    bool exact;        ///< See Progress.
  };

  virtual ~MinimiserCalls() = default;
  virtual double* position(int x) = 0;  ///< The n entries of a position.
  virtual double* gradient(int g) = 0;  ///< The n entries of a gradient.
  /// f at a position; the gradient goes where it says. @return f, and the number of entries that f left in
  /// the gradient, which has n again
  virtual std::pair<double, Eigen::Index> evaluate(int x, int g) = 0;
  /// Tells the callback. @return false where it asks to stop
  virtual bool report(const Place& place) = 0;
};

/// How a run of the minimiser ended, and where.
struct MinimiserEnd {
  Outcome outcome;              ///< How.
  MinimiserCalls::Place place;  ///< The last point that was evaluated and is good.
  std::string message;          ///< See Minimisation.
};

/// Minimises from position 0 of n entries.
MinimiserEnd minimise_by_calls(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options);

}  // namespace detail

/// One run of L-BFGS (memory m > 0) or of a nonlinear conjugate gradient method (m = 0), \f[ x_+ = x + \alpha
/// d, \qquad d = -H \nabla f \quad\text{or}\quad d_+ = \beta d - \nabla f(x_+), \f] with a line search by
/// interpolation that takes one evaluation an iteration where f is nearly quadratic along the line. H is the
/// L-BFGS matrix of the last m pairs, beta that of Hager and Zhang with restarts.
///
/// Seen from Bregman dynamics the second form is a heavy ball, the order-0 HTVI (bregman/bregman_htvi.hpp)
/// whose clock is set by the state and frozen over a step; \f$H^{-1}\f$ is a variable mass matrix.
///
/// **Line interpolation.** One trial along d gives value and slope at two points of the line. Where the
/// values confirm that f is quadratic in between (LineModel), the minimiser of the line and the gradient
/// there follow by interpolation, so an iteration costs one evaluation. Otherwise the trial is taken as it is
/// when it satisfies Wolfe's conditions, or the line is searched. An interpolated point that fails later is
/// evaluated; if f rose, the run goes back to the best point that was evaluated.
///
/// Each operation on vectors is one pass over memory: seven vectors, and 2 m + 1 more. The run is in the
/// library; here are f and the vectors that it sees. Theory, choices of alpha and beta, and measurements:
/// @ref optimisation.
class Minimiser final : detail::MinimiserCalls {
 public:
  /// Value and gradient at a point.
  using Function = std::function<double(const VectorX&, VectorX&)>;

  /// Makes the memory of a run.
  /// @throws std::invalid_argument for options out of range or an empty or non-finite x0.
  Minimiser(Function f, const VectorX& x0, const MinimiseOptions& options)
      : options_(options), f_(std::move(f)), n_(x0.size()) {
    options.validate();
    require(n_ > 0, "Size of x0", n_, "at least 1");
    require(std::isfinite(largest_entry(x0)), "Largest entry of x0", largest_entry(x0), "finite");
    x_[0] = x0;
    for (VectorX* v : {&x_[1], &x_[2], &g_[1], &g_[2]})
      v->setZero(n_);
    g_[0].setConstant(n_, std::numeric_limits<double>::quiet_NaN());  // f that does not fill it is noticed
  }

  /// Minimises. To be called once. @throws std::logic_error for another call.
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
