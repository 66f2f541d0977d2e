#pragma once
#include "src/choice/menu.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

/// @file
/// Two runs with different steps along one orbit, and what they say about its monitor and step.

namespace avi::detail {

/// Phase, in radians, below which errors fluctuate by more than they grow.
inline constexpr double shortest_growth = 400.0;
/// Largest number of pairs of runs.
inline constexpr int most_rounds = 30;
/// Largest number of times that a step is made longer.
inline constexpr int most_lengthened = 2;
/// Largest number of times that the motion is looked at where energy errors are largest.
inline constexpr int most_looks = 6;
/// Part of the tolerance that a step is chosen for, as error predictions fluctuate.
inline constexpr double wanted_part = 0.2;
/// Largest factor between the errors of two runs that is believed.
inline constexpr double most_trusted = 20.0;
/// Tolerance of sweeps that are to leave only rounding, see SweepSettings.
inline constexpr double least_of_sweeps = SweepSettings{}.tolerance;
/// The distance, relative to the ranges, by which residuals of the sweeps move the end of a run. Like the
/// effect of an energy drift, it grows with the square of the number of steps. Measured on runs of 30 to
/// 10 000 steps of order 16, of half a radian to two, whose sweeps end at 1e-6 to 1e-12: the actual distance
/// is a fiftieth to five times as much.
inline double left_by_sweeps(const Journey& run) {
  const auto steps = static_cast<double>(run.run.steps);
  return (0.5 + 5e-4 * steps * steps) * run.solved;
}
/// A bound on the energy error that the sweeps leave, over the energy scale; it does not fall with the step.
/// It is three times the largest error that was seen, on a Kepler orbit with e = 0.9.
inline double energy_left_by_sweeps(const Journey& run) {
  return (10.0 + 0.1 * static_cast<double>(run.run.steps)) * run.solved;
}

/// Estimate of the error of the finer of two runs. Phase errors look larger where the motion is faster, so
/// their growth is measured by the time by which one run lags behind the other.
struct Comparison {
  double error = infinity;     ///< Error at the last mark, relative to the ranges.
  double furthest = infinity;  ///< Largest distance between the two runs at a mark.
  double behind = infinity;    ///< Largest error divided by the speed at its mark: a time lag.
  double growth = 1.0;         ///< Exponent of the power of time with which the lag grows.
  double rate = 0.0;           ///< Rate of exponential growth of the lag, if it may grow so; else 0.
  bool exponential = false;    ///< Whether the lag is seen to grow faster than by any power of time.
};

/// Errors of the whole run, predicted from two runs at a mark.
struct ErrorsAtMark {
  double of_state, of_energy;  ///< Divided by the tolerance, and by three times that.
  bool hidden;                 ///< Whether rounding hides the energy error.
  bool steady;                 ///< Whether the energy error does not fall with the step, for no known reason.
};

/// Largest energy error that rounding of H may explain, unless the terms of H are far larger than H.
inline constexpr double most_rounding = 1e-6;

/// Time in nanoseconds, as estimated by Candidate::price(), that may be spent in vain: on runs that fail, or
/// that no shorter step improves. Before a dead end of the orbit, a tenth of it may be spent.
inline constexpr double patience = 5e8;

/// Monitor, order and step of a pair of runs.
struct Setting {
  Candidate* candidate = nullptr;  ///< The monitor.
  double h = 0.0;                  ///< Fictive step of the finer run.
};

/// The factor by which the error of the finer run is taken to be smaller than that of the coarser one. By the
/// order it would be (coarse h / fine h)^order. Half of that is trusted, and at most a factor of 20: below
/// that, errors are rounding, or come from a feature that neither run resolves.
inline double trusted(const Journey& coarse, const Journey& fine) {
  return std::clamp(0.5 * std::pow(coarse.h / fine.h, fine.order), 1.0, most_trusted);
}

/// The search for monitor, order and step of one orbit. Two runs with different steps follow it side by side,
/// from mark to mark. If they are too far apart, or closer than they need be, the step is changed and they
/// begin again.
class Orbiter {
 public:
  Orbiter(const OrbitQuestion& question, Budget& budget)
      : question_(question), budget_(budget), began_(budget.sweeps), known_(question, budget, answer_),
        menu_(question, known_) {}

  OrbitAnswer solve();

 private:
  // orbiter.cpp
  void set_marks();
  double affordable(Candidate& it, double h);
  [[nodiscard]] bool was_blind(const Setting& setting) const;
  OrbitAnswer look_again(bool closely, std::optional<State<dynamic>> also);

  // pair_of_runs.cpp
  Journey begin(const Setting& setting, double factor);
  void bound(Journey& journey, std::size_t mark);
  bool go_on(Journey& journey, std::size_t mark);
  bool passes_over_start(const Journey& run);
  bool pursue(Setting& setting);
  void keep_furthest();
  void drop_runs();
  void note_trial(const Journey& journey, double error);

  // comparison.cpp
  /// The lag of one run behind the other, in time, divided by the trusted factor.
  struct Lags {
    double early = 0.0;      // largest in the first quarter, or in three eighths if marks are few
    double halfway = 0.0;    // largest in the first half
    double late = 0.0;       // largest of all
    double furthest = 0.0;   // largest distance of the two runs, relative to the ranges
    double last = infinity;  // the distance at the last mark, divided by that factor
    bool runaway = false;    // whether the lag has grown over ten times as much as the square of time
  };
  Lags lags(const Journey& coarse, const Journey& fine, double ratio);
  struct TwoRuns;
  Comparison compare(const Journey& coarse, const Journey& fine);
  double speed_at(const State<dynamic>& z, const Ranges& ranges);
  [[nodiscard]] double lag_at_saddles(const Journey& journey, double unseen) const;
  double rounding_of_clock(const Journey& journey);
  double rounding_of_energy(const Journey& journey);
  bool follows_another_gradient();
  [[nodiscard]] bool passes(const Journey& journey) const;
  [[nodiscard]] double foretold(const Comparison& seen, double from, double to, double speed) const;

  // next_setting.cpp
  enum class Alike { no, rounding, harmless, unexplained };
  void doubt_beginning(std::size_t mark, double of_energy);
  bool is_outrun(double of_energy);
  bool judge(Setting& setting, std::size_t mark);
  void look_at_work(std::size_t mark);
  Alike alike_energies();
  bool again(Setting& setting, double factor);
  bool confirm(Setting& setting, double error, double factor);
  bool lengthen(Setting& setting, std::size_t mark, double factor);
  bool shorten(Setting& setting, std::size_t mark, const ErrorsAtMark& errors, double factor);
  bool try_others(Setting& setting);
  bool take_from_aside(Setting& setting, double others);

  // after_a_failure.cpp
  bool failed(const Journey& journey, Setting& setting);
  bool goes_back(Setting& setting);
  void note_failure(const Journey& journey, const Setting& setting);
  void look_from(const State<dynamic>& z);
  void stay_near(Candidate& it, const Sketch& there);
  Candidate* most_hopeful();

  // verdict.cpp
  OrbitAnswer finish();
  void tell_work(const Journey& fine);
  void tell_error(const Journey& fine, double foreseen);
  void tell_end(const Journey& fine);
  void tell_doubts(const Journey& fine, double foreseen);
  OrbitAnswer give_up();
  [[nodiscard]] std::string given_up(const Journey& run) const;
  OrbitAnswer too_far(const char* what, double t, double radians);
  OrbitAnswer fail(Outcome outcome, std::string message);
  void take_furthest();

  [[nodiscard]] double since_start(std::size_t mark) const { return std::abs(marks_[mark] - question_.t); }
  [[nodiscard]] bool is_further(const Journey& journey, const Journey& other) const {
    return known_.sense * (journey.state.t - other.state.t) > 0.0;
  }
  /// Whether runs are stopped for their price: not if their step is given, or their order is low and needs
  /// many steps.
  [[nodiscard]] bool is_stopped_for_price() const {
    const SolveOptions& options = question_.options;
    return !(options.h > 0.0) && !(options.order > 0 && options.order < 6);
  }
  [[nodiscard]] double its_patience() const { return dead_end_ > 0.0 ? 0.1 * patience : patience; }

  const OrbitQuestion& question_;
  Budget& budget_;
  OrbitAnswer answer_;
  long began_;      // sweeps of the call before this search
  Overview known_;  // what is known before the runs
  Menu menu_;
  bool closely_ = false;  // whether the sketch takes short steps, as one of longer steps was blind
  std::optional<State<dynamic>> also_;  // where the sketch goes on, as the motion is far faster there
  int looks_ = 0;                       // how often the motion was looked at where energy errors are largest
  bool outrun_ = false;                 // it is far faster there
  std::vector<double> marks_;
  std::size_t compared_ = 0;              // number of marks at which two runs are compared
  std::optional<bool> foreign_gradient_;  // whether H supplies a gradient that is not its own, once checked

  // The two runs, and what they show.
  int round_ = 0;  // pairs of runs so far
  double rate_ =
      -1.0;  // rate at which the slope at the start changes with time alone; negative if not known yet
  std::optional<Journey> coarse_, fine_;
  Comparison seen_;
  std::size_t judged_ = 0;       // mark of that comparison
  double resolved_ = 0.0;        // first step that was short enough, as far as the first marks show
  bool confirmed_ = false;       // a third run was asked to confirm the other two, see confirm()
  bool unstable_ = false;        // small errors grow by more than an order of magnitude
  bool coarse_grained_ = false;  // energy errors do not depend on the step
  bool slow_ = false;            // a step was made shorter because its sweeps converged slowly
  bool thin_ = false;            // a step passed over a feature of H, which shorter ones resolve slowly
  bool resigned_ = false;        // shorter steps do not help
  std::size_t resigned_at_ = 0;  // mark at which that was seen
  bool parted_ = false;  // resigned_, and the two runs are as far apart as the motion goes: only one goes on
  bool lost_ = false;    // the two runs part at a point of rest
  // The last two runs agreed, but their energy errors were more than rounding and did not fall with the step.
  bool steady_ = false;

  // Settings so far.
  double before_ = infinity;  // error predicted from the best of the last pairs of runs, and its mark
  std::size_t before_at_ = 0;
  double energy_before_ = infinity;      // energy error of the last pair, unless rounding hides it
  bool forgiven_ = false;                // such a fall has counted as an improvement; only once
  int vain_ = 0;                         // pairs in a row that did not improve on the best one
  int lengthened_ = 0;                   // how often a step was made longer
  Candidate* lengthened_for_ = nullptr;  // candidate whose step was made longer last
  bool others_tried_ = false;            // candidates other than the first one were tried
  Setting instead_of_;                   // setting that was replaced by a candidate set aside before

  // Failures.
  std::optional<Journey> furthest_run_;  // the failed run that came furthest
  double failed_at_ = -1.0;              // time at which the last run failed
  double stalled_at_ = 0.0;              // time at which the last run stalled that did,
  Candidate* stalled_with_ = nullptr;    // and its candidate
  bool owes_look_ = false;               // the look at the last failure was put off
  double furthest_ = 0.0;                // latest time at which a run failed
  double repeated_ = infinity;           // earliest time at which two runs in a row failed
  double dead_end_ = 0.0;        // time that a sketch, or runs with two monitors, cannot pass; 0 if none
  double in_the_way_ = 0.0;      // time at which runs fail with every step; 0 if none
  Outcome bound_ = Outcome::ok;  // bound of the call that a run has met
};

}  // namespace avi::detail
