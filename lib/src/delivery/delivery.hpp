#pragma once
#include "src/choice/budget.hpp"
#include "src/choice/journey.hpp"
#include "src/choice/prepared.hpp"
#include "src/delivery/checkpoint.hpp"
#include "src/delivery/watch.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

/// @file
/// The run whose states are delivered.

namespace avi::detail {

class Track;

/// The plan of a run, made from the runs before it.
struct Plan {
  double horizon;  ///< Time for which the choice was made.
  double pause;    ///< Time beyond which another choice is needed, or none is possible.
  long most = std::numeric_limits<long>::max();  ///< Largest number of steps; the repeated run took fewer.
  Outcome failure = Outcome::ok;                 ///< Outcome of the runs that went further.
  std::string message = {};                      ///< Message of those runs.
};

/// The run that is delivered, with its output times, events and dense output. Its choice was made before.
class Delivery {
 public:
  /// Begins the run at the start of the question. @param degrees number of degrees of freedom that the user
  /// sees @param prepared programs made of H for the choice, or null
  Delivery(const OrbitQuestion& question, int degrees, const Choice& choice, Budget& budget,
           const Prepared* prepared);

  /// Goes on to the end, to an event that ends the run, or to the first step beyond the pause of the plan.
  void go();
  /// Returns true at the end, or at the event that ends the run.
  [[nodiscard]] bool arrived() const { return by_event_ || state_.t == question_.t_end; }
  /// Current state.
  [[nodiscard]] const State<dynamic>& state() const { return state_; }
  /// Steps and sweeps of the run, and how it ended.
  [[nodiscard]] const Run& run() const { return run_; }
  /// Follows this plan; without one, the run goes to the end. With SolveOptions::checkpoint, the file holds
  /// the plan and `report`, too.
  void follow(const SolutionReport& report, Plan plan);
  /// The plan that it follows.
  [[nodiscard]] const Plan& plan() const { return plan_; }
  /// Continues the run of a file, from which question_in() and choice_in() have read already.
  void restore(Record& record, const SolutionReport& report);
  /// Puts the results into the answer, and the reason if the run is not at its end.
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
  /// The pace of the run: the time reached after this number of steps, what the second half of them gained,
  /// and how often in a row that was less than before.
  struct Pace {
    long steps = 1;
    double time = 0.0, gained = 0.0;
    int fading = 0;
  };
  Pace pace_;
  std::string reason_;
  bool by_event_ = false;
  std::size_t next_ = 0;  // number of the next output time
  double energy_error_ = 0.0;
  OrbitPoints states_, event_states_;
  std::vector<int> events_;
  std::shared_ptr<Track> track_;
  SolutionReport report_;  // what was known before the run
  Plan plan_;
  /// The run at the beginning of the current block of steps. Of lists that only grow, it holds the length: to
  /// copy them each time would take work of the order of the square of the steps.
  struct Block {
    State<dynamic> state;
    long steps = 0, evaluations = 0;
    double energy_error = 0.0;
    std::size_t next = 0, states = 0, events = 0, track = 0;
    std::vector<Watch::Memory> watches;
    Pace pace;
  };
  Block block_;
  bool written_ = false;  // the block is in the file
  double due_ = 0.0;      // when the file is due, in seconds of the call
};

/// Reads the question of a run that was kept. @return fingerprint() of that question
std::uint64_t question_in(Record& record, OrbitQuestion& question);
/// Reads the choice of a run that was kept, and what was known before that run.
Choice choice_in(Record& record, SolutionReport& report);

}  // namespace avi::detail
