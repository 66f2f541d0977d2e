#pragma once
#include "budget.hpp"
#include "journey.hpp"
#include "watch.hpp"

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
  Delivery(const OrbitQuestion& question, int degrees, const Choice& choice, Budget& budget);
  ~Delivery();
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;

  /// Goes on to the end, to an event that ends the run, or to the first step beyond the time `pause`.
  void go(double pause);
  /// It is at the end, or at the event that ends it.
  [[nodiscard]] bool arrived() const { return by_event_ || state_.t == question_.t_end; }
  /// An event has ended it.
  [[nodiscard]] bool stopped_by_event() const { return by_event_; }
  /// Where it is.
  [[nodiscard]] const State<dynamic>& state() const { return state_; }
  /// How it ended.
  [[nodiscard]] const Run& run() const { return run_; }
  /// Puts what was found into the answer.
  void deliver(OrbitAnswer& answer) const;

 private:
  void step();
  void find_events(const Stride& stride, State<dynamic>& last);
  void find_outputs(const State<dynamic>& before, const State<dynamic>& after, const State<dynamic>& last);
  void add(OrbitPoints& points, const State<dynamic>& z, double t) const;
  void spend(const StepReport& report) {
    run_.evaluations += report.evaluations;
    if (!report.ok()) run_.outcome = report.outcome;
  }
  void look_at_energy(const State<dynamic>& z);

  const OrbitQuestion& question_;
  int degrees_;
  Budget& budget_;
  PointField field_;
  double energy_at_start_;
  Candidate candidate_;
  double h_, energy_scale_;
  std::unique_ptr<OrbitSteps> steps_;
  std::vector<Watch> watches_;
  State<dynamic> state_;
  Run run_;
  std::string reason_;
  bool by_event_ = false;
  std::size_t next_ = 0;  // output time
  double energy_error_ = 0.0;
  OrbitPoints states_, event_states_;
  std::vector<int> events_;
  std::shared_ptr<Track> track_;
};

}  // namespace avi::detail
