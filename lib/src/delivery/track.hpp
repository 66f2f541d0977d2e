#pragma once
#include "src/choice/journey.hpp"
#include "src/delivery/checkpoint.hpp"

#include <memory>
#include <mutex>
#include <vector>

/// @file
/// A run, kept as the starts of its steps.

namespace avi::detail {

/// The starts of the steps of a run, and its end. A state in between is found by repeating the step from its
/// start, from a constant as first guess, so that it does not depend on what was asked before.
class Track final : public OrbitCurve {
 public:
  /// Makes the empty track of a run with steps h of this method, which has made none.
  Track(std::unique_ptr<OrbitSteps> pattern, const Candidate& candidate, const PointField& field, double h,
        int degrees)
      : pattern_(std::move(pattern)), candidate_(candidate), field_(field), h_(h), degrees_(degrees) {}

  /// Adds a step, or the part of it that belongs to the run.
  void add(const State<dynamic>& before, const State<dynamic>& last) {
    if (starts_.empty()) put(before);
    put(last);
  }
  void at(double t, double* z) const override;
  [[nodiscard]] const std::vector<double>& times() const override { return times_; }
  /// Puts the first of its times, and the states there, into a record.
  void put(Record& record, std::size_t times) const {
    record.put(times_, times);
    record.put(starts_, times * 2 * static_cast<std::size_t>(field_.size()));
  }
  /// Takes times and states from a record.
  void get(Record& record) {
    record.get(times_);
    record.get(starts_);
  }

 private:
  void put(const State<dynamic>& z) {
    times_.push_back(z.t);
    starts_.insert(starts_.end(), z.q.begin(), z.q.end());
    starts_.insert(starts_.end(), z.p.begin(), z.p.end());
  }
  [[nodiscard]] State<dynamic> start(std::size_t k) const;

  std::unique_ptr<OrbitSteps> pattern_;
  // Memory for evaluations, and the last step that was repeated: many times in one step may be asked for.
  mutable std::mutex mutex_;
  mutable Candidate candidate_;
  mutable PointField field_;
  mutable std::unique_ptr<OrbitSteps> repeated_;
  mutable std::size_t step_ = 0;
  mutable State<dynamic> after_;
  double h_;
  int degrees_;
  std::vector<double> times_, starts_;
};

}  // namespace avi::detail
