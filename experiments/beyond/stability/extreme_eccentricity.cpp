#include "avi/problems/kepler.hpp"
#include "common/frame.hpp"
#include "common/methods/methods.hpp"
#include "common/methods/phase.hpp"
#include "common/methods/search.hpp"

#include <algorithm>

// Every monitor, and other methods, from a circular orbit to e = 1 - 1e-8: the largest step that keeps the
// relative energy error below 1e-2 over three periods and the phase error below 0.1 at their end, its cost,
// and how a run with the next larger step fails.

namespace {

using namespace experiment;

constexpr double period = 2.0 * M_PI;

/// A method whose state is in single precision between steps; arithmetic within a step is in double.
struct SinglePrecision {
  avi::AnyMethod<2> method;

  avi::StepReport step(State2& z, double h) {
    const avi::StepReport report = method.step(z, h);
    for (int i = 0; i < 2; ++i) {
      z.q[i] = in_single(z.q[i]);
      z.p[i] = in_single(z.p[i]);
    }
    return report;
  }

 private:
  /// Volatile, because GCC 12 removes the pair of conversions when it vectorises them for AVX-512.
  static double in_single(double x) {
    volatile float single = static_cast<float>(x);
    return single;
  }
};

struct Subject {
  std::string method, monitor;
  bool bounded;
  /// Exponent of 1 - e in the number of steps per orbit as e -> 1; NaN if unknown. Near the pericentre, time
  /// and energy scale as r^1.5 and 1/r, so a method of order s with g = r^m, m <= 1.5, needs h g <= r^1.5
  /// r^(1/s) there. With m = 2 the apocentre limits h, and an orbit takes 2 pi / (h sqrt(1 - e^2)) steps.
  double predicted;
  long cap;  ///< Limit on the steps of one run.
  std::function<Method2(double e)> make;
  std::string precision = "double";  ///< Precision of the state between steps.
};

std::vector<Subject> subjects() {
  constexpr long implicit_cap = 200'000, explicit_cap = 2'000'000;
  std::vector<Subject> all;
  const auto position = [&](const std::string& name, PositionMonitor monitor, double predicted) {
    all.push_back({"stationary8", name, false, predicted, implicit_cap,
                   [=](double) { return stationary(8, monitor); }});
  };
  const auto momentum = [&](const std::string& name, MomentumMonitor monitor) {
    const bool bounded = std::isfinite(monitor.b);
    all.push_back({"stationary8", name, bounded, unknown, implicit_cap, [=](double e) {
                     MomentumMonitor own = monitor;
                     if (bounded) own.a = 0.25 * (1.0 - e);
                     return stationary(8, own);
                   }});
  };
  using P = PositionMonitor;
  using M = MomentumMonitor;
  position("none", {P::none}, -1.5 - 1.0 / 8.0);
  position("r", {P::power_of_radius, 1.0}, -0.5 - 1.0 / 8.0);
  position("r^1.5", {P::power_of_radius, 1.5}, -1.0 / 8.0);
  position("r^2", {P::power_of_radius, 2.0}, -0.5);
  position("arclength", {P::arclength}, unknown);
  momentum("energy", {.kind = M::energy, .b = 2.0});
  momentum("inverse_lagrangian", {M::inverse_lagrangian});
  momentum("inverse_energy_error", {.kind = M::inverse_energy_error, .b = 2.0});
  const auto curve = [&](const std::string& name, PositionMonitor monitor, double predicted) {
    all.push_back({"collocation16", name, false, predicted, implicit_cap,
                   [=](double) { return collocation(16, monitor); }});
  };
  curve("none", {P::none}, -1.5 - 1.0 / 16.0);
  curve("r", {P::power_of_radius, 1.0}, -0.5 - 1.0 / 16.0);
  curve("r^1.5", {P::power_of_radius, 1.5}, -1.0 / 16.0);
  const auto rival = [&](const std::string& name, const std::string& monitor, double predicted) {
    all.push_back(
        {name, monitor, false, predicted, explicit_cap, [=](double) { return explicit_on_kepler(name); }});
  };
  rival("stormer_verlet", "none", -2.0);
  rival("log_hamiltonian", "1/V", 0.0);
  rival("adaptive_verlet", "r^1.5", -0.5);
  rival("hairer_soderlind", "r^1.5", -0.5);
  // The same in single precision. Rounding changes the conserved g (H + p^t); at the pericentre this is an
  // energy error (2 / (1 - e))^1.5 times that at the apocentre.
  for (const auto& [name, monitor] : {std::pair{"stationary8", "r^1.5"}, {"log_hamiltonian", "1/V"}}) {
    Subject single = *std::ranges::find_if(all, [name = name, monitor = monitor](const Subject& s) {
      return s.method == name && s.monitor == monitor;
    });
    single.precision = "single";
    single.make = [make = single.make](double e) {
      Method2 method = make(e);
      method.make = [inner = method.make](const State2& start) { return SinglePrecision{inner(start)}; };
      return method;
    };
    all.push_back(single);
  }
  return all;
}

/// One row per eccentricity, until a run reaches its cap on steps.
void survey(Frame& frame, Table& table, const Subject& subject) {
  for (const int k : frame.quick ? std::vector{0, 1, 3, 4, 7} : std::vector{0, 1, 2, 3, 4, 5, 6, 7, 8}) {
    const double gap = std::pow(10.0, -k);
    const State2 start = avi::Kepler::pericentre(1.0 - gap);
    const Method2 runner = subject.make(1.0 - gap);
    const Limits limits{.time = 3.0 * period, .steps = subject.cap, .energy_error = 1e-2, .phase_error = 0.1};
    const Largest found = largest_step(runner, start, 16.0, limits);
    const bool ok = found.h > 0.0;
    const double steps = found.at.run.steps;
    table.row(subject.method, subject.monitor, subject.precision, subject.bounded, 1.0 - gap, gap, found.h,
              ok ? steps / 3.0 : unknown, ok ? found.at.energy_error : unknown,
              ok ? phase_error(start, found.at.end) : unknown, subject.predicted,
              std::isnan(found.h_beyond) ? "nan" : found.beyond.ending());
    if (!ok && found.beyond.run.outcome == avi::Outcome::step_limit) return;
  }
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table =
      frame.table({"method", "monitor", "precision", "bounded", "eccentricity", "closeness", "h",
                   "steps_per_orbit", "energy_error", "phase_error", "predicted_exponent", "beyond"});
  table.note("h", "largest step that holds |H - H_0| / |H_0| below 1e-2 for three periods and ends within "
                  "0.1 rad of the exact mean longitude, known to 2 %");
  table.note("closeness", "1 - eccentricity");
  table.note("beyond", "how the run with the next larger step ends; nan: none failed");
  const auto all = subjects();
  for (std::size_t i = 0; i < all.size(); ++i) {
    frame.progress(all[i].method + " " + all[i].monitor, i, all.size());
    survey(frame, table, all[i]);
  }
}
