#pragma once
#include "avi/automatic/choice.hpp"
#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/transform/poincare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

/// @file
/// Short runs that find a step size.

namespace avi::detail {

/// A method with one monitor on one orbit: finds the step that gives a wanted energy error.
class Pilot {
 public:
  using Problem =
      Poincare<dynamic, PhaseFunction, PhaseFunction>;  ///< One type for every H and g: compiled once.
  using Point = State<dynamic>;                         ///< Of any dimension.

  /// @param name of the monitor @param order of the method @param energy_scale of energy errors
  Pilot(std::string name, const PhaseFunction& energy, const PhaseFunction& monitor, const Point& start,
        int order, double energy_scale)
      : name_(std::move(name)), energy_(energy), monitor_(monitor), start_(start), order_(order),
        scale_(energy_scale), method_(collocation(poincare(energy, start, monitor), order)) {}

  /// What a search found.
  struct Found {
    double h = 0.0;      ///< Step.
    double steps = 0.0;  ///< Number of steps if the error were exactly the wanted one.
    bool reached = false;
  };

  /// A run until `time` with step h. @param choice where the trial is recorded
  Trial trial(double h, double time, long cap, MonitorChoice& choice) {
    Point z = start_;
    const double h0 = energy_(start_.q, start_.p);
    double worst = 0.0;
    const Run run = integrate(method_, z, h, Until{.time = time, .steps = cap}, [&](const Point& at, long) {
      worst = std::max(worst, std::abs(energy_(at.q, at.p) - h0) / scale_);
      return worst < 1.0;  // beyond that the run is useless
    });
    if (run.outcome != Outcome::ok) worst = std::numeric_limits<double>::infinity();
    const Trial result{name_, h, run.steps, worst, run.outcome};
    choice.sweeps += run.evaluations;
    choice.trials.push_back(result);
    return result;
  }

  /// The step whose largest energy error until `time` is between a third of `tolerance` and all of it, or as
  /// near as few trials come. @param h where to begin @param fewest gives up when more steps than that are
  /// needed @param longest no step above it is tried
  Found search(double h, double time, double tolerance, double fewest, double longest, MonitorChoice& choice,
               int most_trials = 14) {
    const double aim = tolerance / 1.7;
    double good = 0.0, bad = std::numeric_limits<double>::infinity();
    Found found;
    for (int i = 0; i < most_trials; ++i) {
      const long cap = static_cast<long>(std::min(3.0 * fewest + 100.0, 1e6));
      const Trial t = trial(h, time, cap, choice);
      const double ratio = t.energy_error > 0.0 ? aim / t.energy_error : 1e30;
      const double factor = std::pow(ratio, 1.0 / order_), needed = static_cast<double>(t.steps) / factor;
      if (t.energy_error <= tolerance) {
        good = h;
        found = {h, needed, true};
        if (3.0 * t.energy_error >= tolerance || bad < 1.12 * h || h >= longest) break;
        h = std::min({h * std::clamp(factor, 1.06, 1.8), bad < 1e300 ? 0.5 * (h + bad) : 1e300, longest});
      } else {
        bad = h;
        if (t.outcome == Outcome::step_limit || (std::isfinite(t.energy_error) && needed > 1.3 * fewest))
          break;
        const double down = h * (std::isfinite(t.energy_error) ? std::clamp(factor, 0.3, 0.95) : 0.6);
        if (good > 0.0 && bad < 1.12 * good) break;
        h = std::max(down, good > 0.0 ? 0.5 * (good + bad) : 0.0);
      }
    }
    return found;
  }

  [[nodiscard]] const std::string& name() const { return name_; }          ///< Of the monitor.
  [[nodiscard]] const PhaseFunction& monitor() const { return monitor_; }  ///< g.
  [[nodiscard]] Collocation<Problem>& method() { return method_; }         ///< The method itself.

 private:
  std::string name_;
  PhaseFunction energy_, monitor_;
  Point start_;
  int order_;
  double scale_;
  Collocation<Problem> method_;
};

}  // namespace avi::detail
