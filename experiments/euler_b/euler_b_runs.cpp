#include "euler_b/euler_b_runs.hpp"

#include "avi/problems/kepler.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "common/methods/search.hpp"
#include "common/timing.hpp"

#include <stdexcept>

namespace experiment {
namespace {

Method2 euler_b(const EulerBSetting& setting) {
  const avi::Kepler kepler;
  const auto with = [&](const auto& monitor_from) {
    return Method2(kepler, [=](const State2& start) {
      return avi::euler_b<2>(kepler, start, monitor_from(kepler(start.q, start.p)));
    });
  };
  const std::string& monitor = setting.monitor;
  if (monitor == "none") return with([](double) { return avi::Unit{}; });
  if (monitor == "truncation")
    return with([=](double) { return avi::Truncation{kepler, setting.tol, setting.h}; });
  if (monitor == "truncation_root")
    return with([=](double) { return avi::Truncation<avi::Kepler, 4>{kepler, setting.tol, setting.h}; });
  if (monitor == "arclength") return with([=](double energy) { return avi::Arclength{kepler, energy}; });
  if (monitor == "norm_squared") return with([](double) { return avi::NormSquared{}; });
  throw std::invalid_argument("Monitor '" + monitor + "' is unknown.");
}

}  // namespace

EulerBSetting euler_b_setting(const std::string& monitor, double size) {
  if (monitor == "truncation") return {monitor, 1.0, 0.5 * size};
  if (monitor == "truncation_root") return {monitor, 1.0, 0.5 * std::pow(size, 4)};
  return {monitor, size};
}

EulerBResult run_euler_b(const EulerBSetting& setting, double e, double horizon,
                         const EulerBObserver& observe) {
  const Method2 runner = euler_b(setting);
  const avi::Kepler kepler;
  const State2 start = avi::Kepler::pericentre(e);
  const double energy = kepler(start.q, start.p), momentum = avi::Kepler::angular_momentum(start);
  State2 z = start;
  EulerBResult result;
  result.seconds = seconds([&] {
    avi::AnyMethod<2> method = runner.make(start);
    const avi::Run run = avi::integrate(method, z, setting.h, {.time = horizon}, [&](const State2& s, long) {
      const double energy_error = std::abs(kepler(s.q, s.p) - energy);
      const double momentum_error = std::abs(avi::Kepler::angular_momentum(s) - momentum);
      result.energy_error = std::max(result.energy_error, energy_error);
      result.angular_momentum_error = std::max(result.angular_momentum_error, momentum_error);
      if (observe) observe(s, energy_error, momentum_error);
    });
    if (run.outcome != avi::Outcome::ok) throw std::runtime_error(run.message);
    result.steps = run.steps;
  });
  return result;
}

EulerBSetting calibrated_euler_b(const std::string& monitor, double e, double target, double horizon) {
  const auto error = [&](double size) {
    return run_euler_b(euler_b_setting(monitor, size), e, horizon).energy_error;
  };
  // The first start is small enough to be stable for every monitor. Small errors come by way of ten times as
  // large ones, whose runs take a tenth of the steps and find the start within a part in a thousand.
  double size = 1e-3;
  for (double aim = std::max(target, 1e-2), last = aim;; last = aim, aim = std::max(target, 0.1 * aim)) {
    size *= aim / last;
    size = matched_step(error, aim, size, {.order = 1.0, .within = 1e-5, .tries = 7});
    if (!(aim > target)) return euler_b_setting(monitor, size);
  }
}

}  // namespace experiment
