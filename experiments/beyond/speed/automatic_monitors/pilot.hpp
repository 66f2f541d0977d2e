#pragma once
#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/core/outcome.hpp"
#include "avi/transform/poincare.hpp"
#include "beyond/speed/automatic_monitors/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

/// @file
/// Short runs that find a step size.

namespace experiment {

using avi::Collocation, avi::Formula, avi::Outcome, avi::Poincare, avi::Run, avi::State, avi::Until,
    avi::dynamic, avi::poincare;

/// One short run of a pilot.
struct Trial {
  std::string monitor;            ///< Name in the menu.
  double h = 0.0;                 ///< Fictive step.
  long steps = 0;                 ///< Taken.
  long sweeps = 0;                ///< Evaluations of all stages.
  double energy_error = 0.0;      ///< Largest |H - H_0| over the energy scale; infinite where the run failed.
  Outcome outcome = Outcome::ok;  ///< How it ended.
};

/// A method with one monitor on one orbit: finds the step that gives a wanted energy error, one trial at a
/// time, and says after each what that step will cost.
class Pilot {
 public:
  using Problem = Poincare<dynamic, Formula, Formula>;  ///< One type for every H and g: compiled once.

  /// What all trials of a choice share.
  struct Setting {
    const Orbit& orbit;  ///< Of H.
    int order;           ///< Of the method.
    double tolerance;    ///< Energy error asked for.
    double scale;        ///< Of energy errors.
    double end;          ///< Of the trials.
  };

  /// @param name of the monitor @param sweep what a sweep costs @param fictive time of a trial @param longest
  /// no step above it is tried @param supposed step that will do, as long as no run went through
  Pilot(const Setting& setting, std::string name, const Formula& monitor, double sweep, double fictive,
        double longest, double supposed)
      : setting_(setting), name_(std::move(name)), sweep_(sweep), fictive_(fictive), longest_(longest),
        supposed_(supposed), method_(collocation(poincare(setting.orbit.energy, setting.orbit.start, monitor),
                                                 setting.order, {.max_sweeps = most_sweeps})) {}

  /// A run with step h, given up for good after `most` steps, or when its error shows that the cost() will
  /// exceed `dearest`.
  Trial trial(double h, long most, double dearest) {
    State<dynamic> z = setting_.orbit.start;
    const double h0 = setting_.orbit.energy_at_start();
    const double hopeless =
        setting_.tolerance * std::pow(std::min(dearest / usual_cost(h), 1e3), setting_.order);
    double worst = 0.0;
    const Run run = integrate(
        method_, z, h, Until{.time = setting_.end, .steps = most}, [&](const State<dynamic>& at, long) {
          worst = std::max(worst, std::abs(setting_.orbit.energy(at.q, at.p) - h0) / setting_.scale);
          return worst < std::min(1.0, hopeless);  // beyond 1 the run is useless
        });
    lost_ = run.outcome == Outcome::step_limit || worst >= hopeless;
    if (run.outcome != Outcome::ok) worst = infinity;
    note({h, worst, static_cast<double>(run.evaluations)});
    return {name_, h, run.steps, run.evaluations, worst, run.outcome};
  }

  /// The step to try next.
  [[nodiscard]] double next() const {
    const double h = wanted();
    if (good_.h > 0.0) return std::min({h, 2.5 * good_.h, longest_});
    if (bad_.h == infinity) return std::min(h, longest_);
    return std::max(h, 0.3 * bad_.h);
  }
  /// What a run with the step aimed at would cost; infinity after a run that was given up.
  [[nodiscard]] double cost() const {
    if (lost_) return infinity;
    const Seen& near = good_.h > 0.0 ? good_ : bad_;
    if (!std::isfinite(near.error)) return std::max(3.0 * usual_cost(near.h), 0.25 * usual_cost(supposed_));
    return sweep_ * near.sweeps * near.h / std::min(wanted(), longest_);
  }
  /// The number of steps of such a run.
  [[nodiscard]] double steps() const { return fictive_ / std::min(wanted(), longest_); }
  /// A run went through, so that cost() is more than a guess.
  [[nodiscard]] bool passed() const { return good_.h > 0.0 || std::isfinite(bad_.error); }
  /// No better step is to be found: the error is between a third of the tolerance and all of it, or a step
  /// that is hardly longer fails, or is not allowed.
  [[nodiscard]] bool done() const {
    return good_.h > 0.0 &&
           (3.0 * good_.error >= setting_.tolerance || bad_.h < 1.12 * good_.h || good_.h >= longest_);
  }
  [[nodiscard]] double good() const { return good_.h; }  ///< The longest step that met the tolerance, or 0.

 private:
  static constexpr int most_sweeps = 40;  // a step that takes more is too long
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Seen {
    double h, error, sweeps;
  };

  /// Good steps are shorter than all bad ones: a longer one that meets the tolerance does so by chance.
  void note(const Seen& seen) {
    if (seen.error > setting_.tolerance) {
      if (seen.h < bad_.h) bad_ = seen;
      if (seen.h <= good_.h) good_ = {};
    } else if (seen.h > good_.h && seen.h < bad_.h) {
      good_ = seen;
    }
  }
  /// The step for the energy error aimed at: errors go with the power of the order, or of what was seen.
  [[nodiscard]] double wanted() const {
    const double aim = setting_.tolerance / 1.7;
    const auto from = [&](const Seen& seen, double order) {
      return seen.h * std::pow(aim / std::max(seen.error, 1e-300), 1.0 / order);
    };
    if (good_.h == 0.0 && bad_.h == infinity) return supposed_;
    if (good_.h == 0.0) return std::isfinite(bad_.error) ? from(bad_, setting_.order) : 0.6 * bad_.h;
    if (bad_.h == infinity) return from(good_, setting_.order);
    if (!std::isfinite(bad_.error) || good_.error == 0.0) return std::sqrt(good_.h * bad_.h);
    const double h = from(good_, std::log(bad_.error / good_.error) / std::log(bad_.h / good_.h));
    return std::clamp(h, 1.02 * good_.h, std::max(1.02 * good_.h, 0.98 * bad_.h));
  }
  /// Of a run with step h, at eight sweeps a step.
  [[nodiscard]] double usual_cost(double h) const { return 8.0 * sweep_ * fictive_ / h; }

  Setting setting_;
  std::string name_;
  double sweep_, fictive_, longest_, supposed_;
  Collocation<Problem> method_;
  Seen good_{0.0, 0.0, 1.0}, bad_{infinity, infinity, 1.0};
  bool lost_ = false;
};

}  // namespace experiment
