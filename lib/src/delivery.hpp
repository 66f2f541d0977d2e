#pragma once
#include "budget.hpp"
#include "checkpoint.hpp"
#include "journey.hpp"
#include "prepared.hpp"
#include "watch.hpp"

#include <limits>
#include <memory>
#include <vector>

/// @file
/// The run whose states are delivered.

namespace avi::detail {

/// The starts of the steps of a run, from which the states in between are found.
class Track;

/// A run with a choice that is made: output times, events, dense output.
class Delivery {
 public:
  /// From the start of the question on. @param degrees n of the states that the user sees
  /// @param prepared what is made of H for the choice, or null
  Delivery(const OrbitQuestion& question, int degrees, const Choice& choice, Budget& budget,
           const Prepared* prepared);
  ~Delivery();
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;

  /// It makes no more steps than that: the run that it repeats has come further.
  void bound(long most) { most_ = most; }
  /// Goes on to the end, to an event that ends the run, or to the first step beyond the time `pause`.
  void go(double pause);
  /// It is at the end, or at the event that ends it.
  [[nodiscard]] bool arrived() const { return by_event_ || state_.t == question_.t_end; }
  /// Where it is.
  [[nodiscard]] const State<dynamic>& state() const { return state_; }
  /// How it ended.
  [[nodiscard]] const Run& run() const { return run_; }
  /// With SolveOptions::checkpoint, `report` goes into the file, too, and the time for which the choice was
  /// made.
  void keep(const SolutionReport& report, double horizon);
  /// Goes on from a file, of which question_in(), choice_in() and the horizon have been read.
  void restore(Record& record, const SolutionReport& report, double horizon);
  /// Puts what was found into the answer.
  void deliver(OrbitAnswer& answer) const;

 private:
  [[nodiscard]] std::unique_ptr<OrbitSteps> method() {
    return candidate_.steps(choice_.order, {.tolerance = choice_.solved, .most = 60});
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
  double h_;
  std::unique_ptr<OrbitSteps> steps_;
  std::vector<Watch> watches_;
  State<dynamic> state_;
  Run run_;
  long most_ = std::numeric_limits<long>::max(), looked_ = 1;  // steps
  double time_then_ = 0.0, gained_ = 0.0;  // after so many of them, and in the second half of them
  int fading_ = 0;                         // how often that was less than before
  std::string reason_;
  bool by_event_ = false;
  std::size_t next_ = 0;  // output time
  double energy_error_ = 0.0;
  OrbitPoints states_, event_states_;
  std::vector<int> events_;
  std::shared_ptr<Track> track_;
  SolutionReport report_;  // what was known before the run
  double horizon_ = 0.0;
  /// The run at the beginning of the block of steps under way. Of what only grows it has the length: to copy
  /// all of it each time would take the square of the steps.
  struct Block {
    State<dynamic> state;
    long steps = 0, evaluations = 0;
    double energy_error = 0.0;
    std::size_t next = 0, states = 0, events = 0, track = 0;
    std::vector<long> found;
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
