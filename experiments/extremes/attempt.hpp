#pragma once
#include "extremes/phase.hpp"

#include "avi/core/integrate.hpp"

#include <algorithm>
#include <functional>
#include <string>

/// @file
/// Runs that may fail, of methods whose types nobody needs to know.

namespace experiment {

using State2 = avi::State<2>;

/// How far a run goes, and what it must not exceed on the way.
struct Limits {
  double time;
  long steps;
  double energy_error;            ///< |H - H_0| / |H_0| beyond which the run is given up.
  double phase_error = HUGE_VAL;  ///< Of the end, on Kepler's problem, in radians.
};

/// How a run ended.
struct Attempt {
  avi::Run run;
  State2 end;                    ///< The last good state.
  double energy_error = 0.0;     ///< Largest |H - H_0| / |H_0| after any step.
  double least_step = HUGE_VAL;  ///< In physical time, the last step left out.
  bool late = false;             ///< Reached the end, but elsewhere on its orbit.

  /// Reached the end within every bound.
  [[nodiscard]] bool good() const { return run.outcome == avi::Outcome::ok && !late; }
  /// `ok`, `energy` or `phase` where that bound was exceeded, else the outcome's name.
  [[nodiscard]] std::string ending() const {
    if (run.outcome == avi::Outcome::stopped) return "energy";
    return run.outcome == avi::Outcome::ok && late ? "phase" : std::string(avi::name(run.outcome));
  }
};

/// A method whose state is kept in single precision between steps; the arithmetic within a step stays double.
template <class M>
class SingleState {
 public:
  explicit SingleState(M method) : method_(std::move(method)) {}
  avi::StepReport step(State2& z, double h) {
    const avi::StepReport report = method_.step(z, h);
    for (int i = 0; i < 2; ++i) {
      z.q[i] = rounded(z.q[i]);
      z.p[i] = rounded(z.p[i]);
    }
    return report;
  }

 private:
  /// Volatile: GCC 12 drops the pair of conversions where it vectorises them for AVX-512.
  static double rounded(double x) {
    volatile float single = static_cast<float>(x);
    return single;
  }
  M method_;
};

/// A method together with the Hamiltonian whose value is watched.
class Runner {
 public:
  /// Called after every step; false stops the run.
  using Observer = std::function<bool(const State2&)>;

  /// `make(start)` makes the Method for the orbit through `start`.
  template <class H, class Make>
  Runner(const H& hamiltonian, Make make)
      : energy([=](const State2& z) { return hamiltonian(z.q, z.p); }),
        advance([=](const State2& start, State2& z, double h, avi::Until until, const Observer& observer) {
          auto method = make(start);
          return avi::integrate(method, z, h, until, [&](const State2& now, long) { return observer(now); });
        }),
        advance_single([=](const State2& start, State2& z, double h, avi::Until until,
                           const Observer& observer) {
          SingleState method(make(start));
          return avi::integrate(method, z, h, until, [&](const State2& now, long) { return observer(now); });
        }) {}

  std::function<double(const State2&)> energy;  ///< H.
  /// Advances z, a point of the orbit through `start`, with a method made anew.
  std::function<avi::Run(const State2& start, State2& z, double h, avi::Until, const Observer&)> advance;
  /// Same with its state in single precision.
  decltype(advance) advance_single;

  [[nodiscard]] Runner in_single_precision() const {
    Runner other = *this;
    other.advance = advance_single;
    return other;
  }

  /// A whole run with step h.
  Attempt operator()(const State2& start, double h, const Limits& limits) const {
    Attempt attempt{.run = {}, .end = start};
    const double first = energy(start);
    double before = start.t, step = HUGE_VAL;
    attempt.run =
        advance(start, attempt.end, h, {.time = limits.time, .steps = limits.steps}, [&](const State2& z) {
          attempt.least_step = std::min(attempt.least_step, step);
          step = z.t - before;
          before = z.t;
          const double error = std::abs((energy(z) - first) / first);
          if (!(error <= attempt.energy_error)) attempt.energy_error = error;
          return error <= limits.energy_error;
        });
    attempt.late = std::isfinite(limits.phase_error) &&
                   !(std::abs(phase_error(start, attempt.end)) <= limits.phase_error);
    return attempt;
  }
};

}  // namespace experiment
