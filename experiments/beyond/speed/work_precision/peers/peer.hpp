#pragma once
#include "beyond/speed/work_precision/peers/peers.hpp"

#include <functional>
#include <string>
#include <vector>

/// @file
/// Adapter shared by the integrators of other libraries: they take y, f and a tolerance that is both relative
/// and absolute.

namespace experiment::work_precision {

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

void add_gsl(Scene&, const Equations&);
void add_odeint(Scene&, const Equations&);
void add_sundials(Scene&, const Equations&);

}  // namespace experiment::work_precision
