#include "avi/problems/kepler.hpp"
#include "common/frame.hpp"
#include "common/methods/methods.hpp"
#include "common/methods/phase.hpp"
#include "common/power_law.hpp"

// Kepler's orbit with eccentricity 0.9 for up to a million periods: energy, angular momentum and phase at
// each milestone.

namespace {

using namespace experiment;

constexpr double eccentricity = 0.9, period = 2.0 * M_PI;

struct Subject {
  std::string method, monitor;
  double h;
  Method2 run;
  double reach = 1.0;  ///< Factor for the horizon: shorter for a slow method, longer for a fast one.
};

/// The state of a run.
struct Progress {
  State2 z = avi::Kepler::pericentre(eccentricity);
  long periods = 0;
  double energy_error = 0.0, momentum_error = 0.0, phase_error = 0.0, energy_now = 0.0;
};

/// Advances to the apocentre half a period before `periods` periods are complete, checking every step. The
/// phase may lag by up to one per cent (that of Stormer-Verlet lags by one in six hundred).
avi::Run advance(const Subject& subject, Progress& at, long periods) {
  const State2 start = avi::Kepler::pericentre(eccentricity);
  const double energy = subject.run.energy(start), momentum = avi::Kepler::angular_momentum(start);
  bool outwards = at.z.q.dot(at.z.p) >= 0.0;
  avi::AnyMethod<2> method = subject.run.make(start);
  return avi::integrate(
      method, at.z, subject.h, {.time = (1.01 * periods + 10.0) * period}, [&](const State2& z, long) {
        at.energy_now = (subject.run.energy(z) - energy) / energy;
        at.energy_error = std::max(at.energy_error, std::abs(at.energy_now));
        at.momentum_error =
            std::max(at.momentum_error, std::abs(avi::Kepler::angular_momentum(z) / momentum - 1.0));
        const bool was_outwards = std::exchange(outwards, z.q.dot(z.p) >= 0.0);
        if (outwards || !was_outwards) return true;
        // Less than half a turn from the last value, so that whole turns are counted.
        at.phase_error += std::remainder(phase_error(start, z) - at.phase_error, 2.0 * M_PI);
        return ++at.periods < periods;
      });
}

/// Exponent of the growth of an error with the number of periods, over the last 1.5 decades.
double growth(const std::vector<Progress>& marks, double Progress::*error) {
  std::vector<double> periods, values;
  for (const Progress& at : marks)
    if (32 * at.periods >= marks.back().periods && at.*error != 0.0) {  // errors of 0 are below round-off
      periods.push_back(at.periods);
      values.push_back(std::abs(at.*error));
    }
  return power_law(periods, values).slope;
}

std::vector<Subject> subjects() {
  const PositionMonitor monitor{PositionMonitor::power_of_radius, 1.5};
  return {{"stationary4", "r^1.5", 0.05, stationary(4, monitor)},
          {"stationary12", "r^1.5", 0.12, stationary(12, monitor)},
          {"collocation16", "r^1.5", 0.9, collocation(16, monitor), 100.0},
          {"stormer_verlet", "none", period / 2000, explicit_on_kepler("stormer_verlet")},
          {"log_hamiltonian_yoshida4", "1/V", 0.1, explicit_on_kepler("log_hamiltonian_yoshida4")},
          {"runge_kutta_4", "none", period / 4000, explicit_on_kepler("runge_kutta_4"), 0.1}};
}

}  // namespace

void experiment::conduct(Frame& frame) {
  const long periods = frame.quick ? 100 : frame.longer ? 1'000'000 : 1000;
  Table &table = frame.table({"method", "monitor", "h", "periods", "energy_error", "momentum_error",
                              "phase_error", "energy_now"}),
        &laws = frame.table("laws", {"method", "energy", "momentum", "phase"});
  table.note("eccentricity", eccentricity);
  table.note("errors",
             "largest relative ones of energy and angular momentum up to then; mean longitude in radians");
  table.note("energy_now", "at the row's apocentre; rounding moves g (H + p^t), so that H moves by it over "
                           "g and most at the pericentre");
  laws.note("laws", "power of time with which an error grows in the last 1.5 decades");
  for (const Subject& s : subjects()) {
    const long end = std::clamp(std::lround(s.reach * periods), 10L, std::max(periods, 1'000'000L));
    Progress at;
    std::vector<Progress> marks;
    for (double goal = 1.0; at.periods < end; goal *= std::pow(10.0, 0.125)) {
      const long next = std::min(std::lround(goal), end);
      if (next <= at.periods) continue;
      frame.progress(s.method, at.periods, end);
      const avi::Run run = advance(s, at, next);
      if (run.outcome != avi::Outcome::stopped)
        throw std::runtime_error(s.method + ": " +
                                 (run.message.empty() ? "too few turns in that time" : run.message));
      marks.push_back(at);
      table.row(s.method, s.monitor, s.h, at.periods, at.energy_error, at.momentum_error, at.phase_error,
                at.energy_now);
    }
    laws.row(s.method, growth(marks, &Progress::energy_error), growth(marks, &Progress::momentum_error),
             growth(marks, &Progress::phase_error));
  }
}
