#include "kepler/table.hpp"

#include "avi/problems/kepler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace experiment {

namespace {

void require_ok(const avi::Run& run) {
  if (run.outcome != avi::Outcome::ok) throw std::runtime_error(run.message);
}

}  // namespace

KeplerResult KeplerRun::measure() const {
  KeplerResult result{
      .min_step = std::numeric_limits<double>::infinity(), .max_step = 0.0, .energy_error = 0.0};
  State2 before_last = start, previous = start;
  const double start_energy = runner.energy(start);
  observe([&](const State2& s) {
    result.min_step = std::min(result.min_step, s.t - previous.t);
    result.max_step = std::max(result.max_step, s.t - previous.t);
    result.energy_error = std::max(result.energy_error, std::abs(runner.energy(s) - start_energy));
    before_last = previous;
    previous = s;
    ++result.steps;
  });
  const State2 exact = avi::Kepler::exact(eccentricity, previous.t);
  result.global_error = (previous.q - exact.q).norm();
  result.global_error_shifted = (before_last.q - exact.q).norm();
  return result;
}

void KeplerRun::run() const {
  State2 z = start;
  require_ok(runner.prepare(start)(z, row.h, until));
}

void KeplerRun::observe(const std::function<void(const State2&)>& observer) const {
  State2 z = start;
  require_ok(runner.advance(start, z, row.h, until, [&](const State2& s) { return observer(s), true; }));
}

}  // namespace experiment
