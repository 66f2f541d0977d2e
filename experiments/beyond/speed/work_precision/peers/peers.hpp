#pragma once
#include "beyond/speed/work_precision/family.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

// The problem as other libraries see it, and their integrators as families. They take y, f and a tolerance
// that is both relative and absolute.

namespace experiment::work_precision {

/// The equations y' = f(y) for y = (q, p), from t = 0 to the horizon, and the starts.
struct Equations {
  double horizon;
  std::shared_ptr<const void> problem;
  int (*field)(double t, const double* y, double* f, void* self);  ///< `self` points to a RightHandSide.
  std::function<double(const double* y)> energy;
  std::vector<std::vector<double>> start{};
};

/// The argument `self` of the field: the problem, and a counter of calls.
struct RightHandSide {
  const void* problem;
  long evaluations = 0;
};

/// One integration.
struct Task {
  const Equations& equations;
  double tolerance;
  long step_cap;
  std::vector<double> y;                       ///< Initially the start, finally the state at the horizon.
  std::function<void(const double* y)> watch;  ///< If not empty, to be called after every step.
  RightHandSide f{equations.problem.get()};
  long steps = 0;

  /// Counts a step. @return whether the run may continue
  bool stepped(const double* now) {
    if (watch) watch(now);
    return ++steps <= step_cap;
  }
};

/// Makes a family of an integrator: solve(task) integrates up to the horizon and returns whether it got
/// there. The set-up of the library's workspace is included in the time.
Family peer(const Equations& equations, std::string method, int order, std::function<bool(Task&)> solve);

void add_odeint(Scene&, const Equations&);
void add_sundials(Scene&, const Equations&);
/// Adds the integrators of the libraries that were found at configure time.
void add_peers(Scene&, const Equations&);
/// The libraries present, such as `GSL 2.7.1, Boost.odeint 1.74, SUNDIALS absent`.
std::string peers_present();

}  // namespace experiment::work_precision
