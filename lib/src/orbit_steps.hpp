#pragma once
#include "avi/core/state.hpp"
#include "kinks.hpp"
#include "stepper.hpp"
#include "switches.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

/// @file
/// The steps of an orbit, of any method.

namespace avi::detail {

/// A method at states, whose steps end where H switches with time, or has a kink.
class OrbitSteps {
 public:
  /// A method for n degrees of freedom.
  OrbitSteps(std::unique_ptr<Stepper> steps, Eigen::Index n) : steps_(std::move(steps)), n_(n), z_(2 * n) {}

  /// No step goes on beyond a switch: it ends at the last time before it, and the next one begins there with
  /// the momentum of time behind it. @param fixed dt by d tau is 1
  void end_at(const Switches& switches, bool fixed) {
    switches_ = std::make_unique<Switches>(switches);
    fixed_ = fixed;
    rate_ = fixed ? 1.0 : 0.0;
  }

  /// No step goes on beyond a kink of H.
  void end_at(const Kinks& kinks) { kinks_ = std::make_unique<Kinks>(kinks); }

  /// Advances z by the fictive step h, or by a shorter one to a switch or kink, unless the report says
  /// another outcome than ok.
  StepReport step(State<dynamic>& z, double h) { return kinks_ ? step_to_kink(z, h) : step_inside(z, h); }
  /// The same for a step inside one that was made, in which is no kink.
  StepReport step_inside(State<dynamic>& z, double h) {
    if (switches_) return step_to_switch(z, h);
    size_ = h;
    return whole_step(z, h);
  }
  /// The last step began at a kink and ended at one, wherever it was to end.
  [[nodiscard]] bool is_between_kinks() const { return between_; }
  /// The energy at this time says nothing: H switches there.
  [[nodiscard]] bool is_at_switch(double t) const { return switches_ && switches_->is_near(t); }
  /// The fictive size of the last step.
  [[nodiscard]] double size() const { return size_; }
  /// See Stepper.
  [[nodiscard]] bool can_go_beside() const { return !switches_ && !kinks_ && steps_->can_go_beside(); }
  /// A step of this orbit and one of another: see Stepper.
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
  /// The same as 2n entries and a time.
  void polynomial(double c, VectorX& z, double& t) const { steps_->polynomial(c, z.data(), t); }

  /// See Stepper.
  void roughly(double c, VectorX& z, double& t) { steps_->roughly(c, z.data(), t); }

  /// See Stepper. @param z of 2n entries
  void tail(VectorX& z) const { steps_->tail(z.data(), static_cast<int>(z.size())); }

  /// Another one with the memory of the last step.
  [[nodiscard]] std::unique_ptr<OrbitSteps> clone() const {
    auto other = std::make_unique<OrbitSteps>(steps_->clone(), n_);
    if (switches_) other->switches_ = std::make_unique<Switches>(*switches_);
    if (kinks_) other->kinks_ = std::make_unique<Kinks>(*kinks_);
    other->size_ = size_, other->fixed_ = fixed_, other->rate_ = rate_, other->ahead_ = ahead_;
    other->between_ = between_, other->kink_ = kink_;
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
  void guess(const Kinks::Crossing& kink, double& part, double& slope);
  void load(const State<dynamic>& z) { std::copy_n(z.p.data(), n_, std::copy_n(z.q.data(), n_, z_.data())); }
  void store(State<dynamic>& z) const {
    std::copy_n(z_.data(), n_, z.q.data());
    std::copy_n(z_.data() + n_, n_, z.p.data());
  }
  std::unique_ptr<Stepper> steps_;
  Eigen::Index n_;
  VectorX z_;  // of the step under way
  double size_ = 0.0;
  std::unique_ptr<Switches> switches_;
  std::unique_ptr<Kinks> kinks_;
  VectorX inside_;  // scratch
  bool between_ = false;
  double kink_ = std::numeric_limits<double>::quiet_NaN();  // time of that at which the last step ended
  bool fixed_ = false;
  double rate_ = 0.0;   // mean dt by d tau of the last step, or 0 where there was none
  double ahead_ = 0.0;  // time by which rounding has set the clock back since the last switch
};

}  // namespace avi::detail
