#pragma once
#include "beyond/speed/work_precision/family.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// @file
/// What other libraries see of a problem, and their integrators as families.

namespace experiment::work_precision {

/// y' = f(y) for y = (q, p) from t = 0 to the horizon, from each of the starts.
struct Equations {
  double horizon;
  std::shared_ptr<const void> problem;
  int (*field)(double t, const double* y, double* f, void* self);  ///< `self` is a RightHandSide.
  std::function<double(const double* y)> energy;
  std::vector<std::vector<double>> start{};
};

/// What f is called with, and how often it was.
struct RightHandSide {
  const void* problem;
  long evaluations = 0;
};

/// Integrators of the other libraries that were found at configure time.
void add_peers(Scene&, const Equations&);
/// `GSL 2.7.1, Boost 1.74, SUNDIALS absent`.
std::string peers_present();

}  // namespace experiment::work_precision
