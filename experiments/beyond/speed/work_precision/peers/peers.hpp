#pragma once
#include "beyond/speed/work_precision/family.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

// The view that other libraries have of a problem, and their integrators as families. They take y, f and a
// tolerance that is both relative and absolute.

namespace experiment::work_precision {

/// y' = f(y) for y = (q, p) from t = 0 to the horizon, from each of the starts.
struct Equations {
  double horizon;
  std::shared_ptr<const void> problem;
  int (*field)(double t, const double* y, double* f, void* self);  ///< `self` is a RightHandSide.
  std::function<double(const double* y)> energy;
  std::vector<std::vector<double>> start{};
};

/// The arguments of f, and the number of its calls.
struct RightHandSide {
  const void* problem;
  long evaluations = 0;
};

/// One integration.
struct Task {
  const Equations& equations;
  double tolerance;
  long step_cap;
  std::vector<double> y;                       ///< At the start, then at the horizon.
  std::function<void(const double* y)> watch;  ///< To be called after every step, unless empty.
  RightHandSide f{equations.problem.get()};
  long steps = 0;

  /// Counts a step. @return whether the run may go on
  bool stepped(const double* now) {
    if (watch) watch(now);
    return ++steps <= step_cap;
  }
};

/// solve(task) integrates up to the horizon and says whether it got there. The library's workspace is part of
/// the time.
Family peer(const Equations& equations, std::string method, int order, std::function<bool(Task&)> solve);

void add_odeint(Scene&, const Equations&);
void add_sundials(Scene&, const Equations&);
/// Integrators of the other libraries that were found at configure time.
void add_peers(Scene&, const Equations&);
/// `GSL 2.7.1, Boost 1.74, SUNDIALS absent`.
std::string peers_present();

}  // namespace experiment::work_precision
