#pragma once
#include "budget.hpp"
#include "checkpoint.hpp"
#include "journey.hpp"
#include "prepared.hpp"
#include "watch.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

/// @file
/// The run whose states are delivered.

namespace avi::detail {

class Track;

/// The plan of a run, from the runs before it.
struct Plan {
  double horizon;  ///< Time for which the choice was made.
  double pause;    ///< Beyond this time another choice has to be made, or none can be.
  long most = std::numeric_limits<long>::max();  ///< Steps: the run that it repeats has come further.
  Outcome failure = Outcome::ok;                 ///< How the runs ended that went beyond it.
  std::string message = {};                      ///< Why they failed.
};

/// A run with a choice that is made: output times, events, dense output.
class Delivery {
 public:
  /// From the start of the question on. @param degrees n of the states that the user sees
  /// @param prepared what is made of H for the choice, or null
  Delivery(const OrbitQuestion& question, int degrees, const Choice& choice, Budget& budget,
           const Prepared* prepared);

  /// Goes on to the end, to an event that ends the run, or to the first step beyond the pause of the plan.
  void go();
  /// It is at the end, or at the event that ends it.
  [[nodiscard]] bool arrived() const { return by_event_ || state_.t == question_.t_end; }
  /// Where it is.
  [[nodiscard]] const State<dynamic>& state() const { return state_; }
  /// How it ended.
  [[nodiscard]] const Run& run() const { return run_; }
  /// Follows this plan; without one it goes to the end. With SolveOptions::checkpoint it goes into the file,
  /// and `report`, too.
  void follow(const SolutionReport& report, Plan plan);
  /// The plan.
  [[nodiscard]] const Plan& plan() const { return plan_; }
  /// Goes on from a file, of which question_in() and choice_in() have been read.
  void restore(Record& record, const SolutionReport& report);
  /// Puts what was found into the answer, and why the run ended where it is not at its end.
  void deliver(OrbitAnswer& answer) const;

 private:
  [[nodiscard]] std::unique_ptr<OrbitSteps> method() {
    return candidate_.steps(choice_.order, {.tolerance = choice_.solved, .max_sweeps = 60});
  }
  void step();
  void find_events(const Stride& stride, State<dynamic>& last);
  void find_outputs(const State<dynamic>& before, const State<dynamic>& after, const State<dynamic>& last);
  void begin_block();
  void write();
  void add(OrbitPoints& points, const State<dynamic>& z, double t) const;
  void spend(const StepReport& report) {
    run_.evaluations += report.evaluations;
    if (!report.ok()) run_.outcome = report.outcome;
  }
  void look_at_energy(const State<dynamic>& z);
  void look_at_pace();

  const OrbitQuestion& question_;
  int degrees_;
  Budget& budget_;
  PointField field_;
  double energy_at_start_;
  Candidate candidate_;
  Choice choice_;
  double sense_, h_;
  std::unique_ptr<OrbitSteps> steps_;
  std::vector<Watch> watches_;
  State<dynamic> state_;
  Run run_;
  /// How far the run had come after so many steps, in the second half of them, and how often that was less
  /// than before.
  struct Pace {
    long steps = 1;
    double time = 0.0, gained = 0.0;
    int fading = 0;
  };
  Pace pace_;
  std::string reason_;
  bool by_event_ = false;
  std::size_t next_ = 0;  // output time
  double energy_error_ = 0.0;
  OrbitPoints states_, event_states_;
  std::vector<int> events_;
  std::shared_ptr<Track> track_;
  SolutionReport report_;  // what was known before the run
  Plan plan_;
  /// The run at the beginning of the block of steps under way. Of what only grows it has the length: to copy
  /// all of it each time would take the square of the steps.
  struct Block {
    State<dynamic> state;
    long steps = 0, evaluations = 0;
    double energy_error = 0.0;
    std::size_t next = 0, states = 0, events = 0, track = 0;
    std::vector<Watch::Memory> watches;
    Pace pace;
  };
  Block block_;
  bool written_ = false;  // as it is now in the file
  double due_ = 0.0;      // when it is to be written, in seconds of the call
};

/// Reads the question of a kept run. @return fingerprint() of what was asked then
std::uint64_t question_in(Record& record, OrbitQuestion& question);
/// Reads the choice, and what was known of the run before it was made.
Choice choice_in(Record& record, SolutionReport& report);

}  // namespace avi::detail
