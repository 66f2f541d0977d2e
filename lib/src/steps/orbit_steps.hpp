#pragma once
#include "avi/core/state.hpp"
#include "src/features/kinks.hpp"
#include "src/features/switches.hpp"
#include "src/steps/stepper.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

/// @file
/// The steps of an orbit, by any method.

namespace avi::detail {

/// A method that advances states. Its steps end where H switches with time, and at its kinks.
class OrbitSteps {
 public:
  /// Takes a method for n degrees of freedom.
  OrbitSteps(std::unique_ptr<Stepper> steps, Eigen::Index n) : steps_(std::move(steps)), n_(n), z_(2 * n) {}

  /// Makes steps end at switches: a step ends at the last time before a switch, and the next one begins
  /// behind it, with the momentum of time that belongs there. @param fixed whether dt/dtau is 1
  void end_at(const Switches& switches, bool fixed) {
    switches_ = std::make_unique<Switches>(switches);
    fixed_ = fixed;
    rate_ = fixed ? 1.0 : 0.0;
  }

  /// Makes steps end at kinks of H, too.
  void end_at(const Kinks& kinks) { kinks_ = std::make_unique<Kinks>(kinks); }

  /// Advances z by the fictive step h, or by a shorter one that ends at a switch or kink, unless the report
  /// has another outcome than ok.
  StepReport step(State<dynamic>& z, double h) { return kinks_ ? step_to_kink(z, h) : step_inside(z, h); }
  /// Makes a step inside one that was made already, so that there is no kink in it.
  StepReport step_inside(State<dynamic>& z, double h) {
    if (switches_) return step_to_switch(z, h);
    size_ = h;
    return whole_step(z, h);
  }
  /// Returns true if the last step was made to end at a kink.
  [[nodiscard]] bool ended_at_kink() const { return at_kink_; }
  /// Returns true if H switches at this time, so that its value there says nothing.
  [[nodiscard]] bool is_at_switch(double t) const { return switches_ && switches_->is_near(t); }
  /// Fictive size of the last step.
  [[nodiscard]] double size() const { return size_; }
  /// Whether two orbits can be stepped side by side: see Stepper.
  [[nodiscard]] bool can_go_beside() const { return !switches_ && !kinks_ && steps_->can_go_beside(); }
  /// Makes a step of this orbit and one of another: see Stepper.
  std::pair<StepReport, StepReport> step_beside(State<dynamic>& z, double h, OrbitSteps& other,
                                                State<dynamic>& its, double its_h) {
    size_ = h, other.size_ = its_h;
    load(z), other.load(its);
    const auto reports =
        steps_->step_beside({z_.data(), &z.t, h}, *other.steps_, {other.z_.data(), &its.t, its_h});
    store(z), other.store(its);
    return reports;
  }
  /// The state at the fraction c of the last step: see Stepper.
  [[nodiscard]] State<dynamic> polynomial(double c) const {
    VectorX z(2 * n_);
    State<dynamic> state;
    polynomial(c, z, state.t);
    state.q = z.head(n_);
    state.p = z.tail(n_);
    return state;
  }
  /// The same state as 2n entries and a time.
  void polynomial(double c, VectorX& z, double& t) const { steps_->polynomial(c, z.data(), t); }

  /// The state at a fraction of the last step with a few digits: see Stepper.
  void roughly(double c, VectorX& z, double& t) { steps_->roughly(c, z.data(), t); }

  /// The last term of the polynomial of the last step: see Stepper. @param z of 2n entries
  void tail(VectorX& z) const { steps_->tail(z.data(), static_cast<int>(z.size())); }

  /// A copy with the memory of the last step.
  [[nodiscard]] std::unique_ptr<OrbitSteps> clone() const {
    auto other = std::make_unique<OrbitSteps>(steps_->clone(), n_);
    if (switches_) other->switches_ = std::make_unique<Switches>(*switches_);
    if (kinks_) other->kinks_ = std::make_unique<Kinks>(*kinks_);
    other->size_ = size_, other->fixed_ = fixed_, other->rate_ = rate_, other->ahead_ = ahead_;
    other->at_kink_ = at_kink_;
    return other;
  }

 private:
  StepReport whole_step(State<dynamic>& z, double h) {
    load(z);
    const StepReport report = steps_->step(z_.data(), z.t, h);
    store(z);
    return report;
  }
  StepReport step_to_switch(State<dynamic>& z, double h);
  StepReport stop_at_switch(const State<dynamic>& from, double h, double time, State<dynamic>& z);
  StepReport step_to_kink(State<dynamic>& z, double h);
  std::optional<Kinks::Crossing> first_kink(const State<dynamic>& from, const State<dynamic>& to);
  double kink_at(std::size_t i, double c);
  void load(const State<dynamic>& z) { std::copy_n(z.p.data(), n_, std::copy_n(z.q.data(), n_, z_.data())); }
  void store(State<dynamic>& z) const {
    std::copy_n(z_.data(), n_, z.q.data());
    std::copy_n(z_.data() + n_, n_, z.p.data());
  }
  std::unique_ptr<Stepper> steps_;
  Eigen::Index n_;
  VectorX z_;  // (q, p) in the current step
  double size_ = 0.0;
  std::unique_ptr<Switches> switches_;
  std::unique_ptr<Kinks> kinks_;
  VectorX inside_;  // scratch
  bool at_kink_ = false;
  bool fixed_ = false;
  double rate_ = 0.0;   // mean dt/dtau of the last step, or 0 before the first
  double ahead_ = 0.0;  // time by which rounding has put back the clock since the last switch
};

}  // namespace avi::detail
