#pragma once
#include "kepler/table.hpp"

#include "avi/core/integrate.hpp"
#include "avi/problems/kepler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

/// @file
/// One run of any method along a Kepler orbit, with the errors that the tables quote.

namespace experiment {

/// @throws std::runtime_error when the run does not reach its end.
inline void require_ok(const avi::Run& run) {
  if (run.outcome != avi::Outcome::ok) throw std::runtime_error(run.message);
}

template <class Method>
KeplerResult measure_kepler(Method method, double e, double h, avi::Until until) {
  const avi::Kepler kepler;
  avi::State<2> z = avi::Kepler::pericentre(e), before_last = z;
  const double start_energy = kepler(z.q, z.p);
  KeplerResult result{
      .min_step = std::numeric_limits<double>::infinity(), .max_step = 0.0, .energy_error = 0.0};
  avi::State<2> previous = z;
  const auto run = avi::integrate(method, z, h, until, [&](const avi::State<2>& s, long) {
    result.min_step = std::min(result.min_step, s.t - previous.t);
    result.max_step = std::max(result.max_step, s.t - previous.t);
    result.energy_error = std::max(result.energy_error, std::abs(kepler(s.q, s.p) - start_energy));
    before_last = previous;
    previous = s;
  });
  require_ok(run);
  const auto exact = avi::Kepler::exact(e, z.t);
  result.global_error = (z.q - exact.q).norm();
  result.global_error_shifted = (before_last.q - exact.q).norm();
  result.steps = run.steps;
  return result;
}

/// The KeplerRun from a method that is copied afresh for each run.
template <class Method>
KeplerRun kepler_run(std::string method_name, std::string construction, const KeplerRow& row,
                     const Method& method, double e, avi::Until until) {
  return {std::move(method_name),
          std::move(construction),
          row,
          [=] { return measure_kepler(method, e, row.h, until); },
          [=] {
            Method fresh = method;
            avi::State<2> z = avi::Kepler::pericentre(e);
            require_ok(avi::integrate(fresh, z, row.h, until));
          },
          [=](const std::function<void(const avi::State<2>&)>& observer) {
            Method fresh = method;
            avi::State<2> z = avi::Kepler::pericentre(e);
            require_ok(
                avi::integrate(fresh, z, row.h, until, [&](const avi::State<2>& s, long) { observer(s); }));
          }};
}

}  // namespace experiment
