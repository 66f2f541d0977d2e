#pragma once
#include "avi/collocation/stage_values.hpp"
#include "avi/core/summation.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "src/steps/stage_formula.hpp"
#include "src/steps/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

/// @file
/// Explicit steps for H = T(p) + V(q) with T quadratic.

namespace avi::detail {

namespace {

/// The Runge-Kutta-Nystrom splitting of order 6 with 14 kicks of Blanes and Moan (2002), whose drifts
/// \f$q \mathrel{+}= a h\,\partial T/\partial p\f$ and kicks \f$p \mathrel{-}= b h\,\partial V/\partial q\f$
/// are exact flows. Rounding errors are kept and added later, as long as each step begins where the last one
/// ended (see Splitting). Two orbits are stepped for the price of one.
class SplittingSteps final : public Stepper {
 public:
  /// Takes formulas with g = 1.
  explicit SplittingSteps(std::shared_ptr<const Formulas> formulas)
      : formulas_(std::move(formulas)), code_(machine_code<lanes>(*formulas_)),
        forces_(formulas_->forces, {}, code_.get(), 0),
        velocities_(formulas_->velocities, {}, code_.get(), 1), here_(formulas_->n), end_(here_),
        q_(formulas_->n), p_(q_), low_q_(q_), low_p_(q_), change_(q_) {
    end_.state.t = std::numeric_limits<double>::quiet_NaN();  // equal to no state: no rounding error is known
  }

  StepReport step(double* z, double& t, double h) override {
    begin(z, t);
    put(0, here_), put(1, here_);
    move(Scalar(h));
    return end(*this, 0, z, t, h);
  }
  [[nodiscard]] bool can_go_beside() const override { return true; }
  std::pair<StepReport, StepReport> step_beside(const Due& mine, Stepper& beside, const Due& its) override {
    auto& other = static_cast<SplittingSteps&>(beside);
    begin(mine.z, *mine.t);
    other.begin(its.z, *its.t);
    put(0, here_), put(1, other.here_);
    Scalar h(its.h);
    h.set(0, mine.h);
    move(h);
    return {end(*this, 0, mine.z, *mine.t, mine.h), other.end(*this, 1, its.z, *its.t, its.h)};
  }
  /// The state after a part of the last step, by a step of that size: as accurate as the end.
  void polynomial(double c, double* z, double& t) const override {
    SplittingSteps aside(*this);
    std::copy(here_.state.q.begin(), here_.state.q.end(), z);
    std::copy(here_.state.p.begin(), here_.state.p.end(), z + here_.state.q.size());
    t = here_.state.t;
    aside.end_ = here_;
    (void)aside.step(z, t, c * h_);
  }
  /// Hermite's polynomials through both ends of the step: of degree 5 for q, with its two derivatives, and of
  /// degree 3 for p.
  void roughly(double c, double* z, double& t) override {
    if (!has_slopes_) find_slopes();
    const Eigen::Index n = q_.size();
    const double square = c * c, cube = square * c, rest = 1.0 - c;
    const double end = cube * (10.0 + c * (6.0 * c - 15.0)),
                 v0 = c * (1.0 + square * (c * (8.0 - 3.0 * c) - 6.0)),
                 v1 = cube * (c * (7.0 - 3.0 * c) - 4.0), a0 = 0.5 * square * rest * rest * rest,
                 a1 = 0.5 * cube * rest * rest;
    const double late = square * (3.0 - 2.0 * c), f0 = c * rest * rest, f1 = -square * rest;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Scalar v = h_ * velocity_[i], a = h_ * h_ * acceleration_[i], f = h_ * force_[i];
      const double q0 = here_.state.q[i], p0 = here_.state.p[i];
      z[i] = q0 + end * (end_.state.q[i] - q0) + v0 * v[0] + v1 * v[1] + a0 * a[0] + a1 * a[1];
      z[n + i] = p0 + late * (end_.state.p[i] - p0) + f0 * f[0] + f1 * f[1];
    }
    t = here_.state.t + c * h_;
  }
  [[nodiscard]] std::unique_ptr<Stepper> clone() const override {
    return std::make_unique<SplittingSteps>(*this);
  }

 private:
  static constexpr int lanes = 2;  // one for each orbit
  static constexpr Lengths<double> drifts{splittings::blanes_moan6_nystrom.a},
      kicks{splittings::blanes_moan6_nystrom.b};
  using Scalar = Pack<lanes>;
  using Vec = Vector<Scalar, dynamic>;

  /// Begins a step here, with the rounding error of the step that led here.
  void begin(const double* z, double t) {
    const Eigen::Index n = q_.size();
    const State<dynamic>& last = end_.state;
    if (last.t == t && std::equal(z, z + n, last.q.data()) && std::equal(z + n, z + 2 * n, last.p.data())) {
      std::swap(here_, end_);
      return;
    }
    std::copy(z, z + n, here_.state.q.data());
    std::copy(z + n, z + 2 * n, here_.state.p.data());
    here_.state.t = t;
    here_.low.q.setZero();
    here_.low.p.setZero();
    here_.low.t = 0.0;
  }
  void put(int lane, const PreciseState<dynamic>& from) {
    for (Eigen::Index i = 0; i < q_.size(); ++i) {
      q_[i].set(lane, from.state.q[i]);
      p_[i].set(lane, from.state.p[i]);
      low_q_[i].set(lane, from.low.q[i]);
      low_p_[i].set(lane, from.low.p[i]);
    }
  }
  void move(const Scalar& h) {
    const auto drift = [&](std::size_t k) {
      velocities_.run(q_, p_, drifts[k] * h, change_.data());
      add(q_, low_q_);
    };
    for (std::size_t k = 0; k < kicks.size(); ++k) {
      drift(k);
      forces_.run(q_, p_, -kicks[k] * h, change_.data());
      add(p_, low_p_);
    }
    drift(kicks.size());
  }
  /// Finds velocities, forces and accelerations at both ends of the last step, one end in each lane.
  void find_slopes() {
    const Eigen::Index n = q_.size();
    for (Vec* each : {&velocity_, &force_, &acceleration_})
      each->resize(n);
    put(0, here_), put(1, end_);
    velocities_.run(q_, p_, Scalar(1.0), velocity_.data());
    forces_.run(q_, p_, Scalar(-1.0), force_.data());
    // Velocities are linear in p.
    for (Eigen::Index i = 0; i < n; ++i)
      p_[i] = p_[i] + force_[i];
    velocities_.run(q_, p_, Scalar(1.0), acceleration_.data());
    for (Eigen::Index i = 0; i < n; ++i)
      acceleration_[i] = acceleration_[i] - velocity_[i];
    has_slopes_ = true;
  }
  /// Adds the change to x, with what rounding cut off before. This goes pack by pack, as the
  /// formulas have just written the change: the processor would have to wait if it read other portions.
  void add(Vec& x, Vec& low) const {
    for (Eigen::Index i = 0; i < x.size(); ++i)
      avi::add(x[i], low[i], change_[i]);
  }
  /// Ends the step that `moved` has made in a lane.
  StepReport end(const SplittingSteps& moved, int lane, double* z, double& t, double h) {
    const Eigen::Index n = q_.size();
    const StepReport report{.evaluations = static_cast<int>(kicks.size())};
    for (Eigen::Index i = 0; i < n; ++i)
      if (!std::isfinite(moved.q_[i][lane]) || !std::isfinite(moved.p_[i][lane]))
        return {.outcome = Outcome::non_finite, .evaluations = report.evaluations};
    h_ = h;
    has_slopes_ = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      z[i] = end_.state.q[i] = moved.q_[i][lane];
      z[n + i] = end_.state.p[i] = moved.p_[i][lane];
      end_.low.q[i] = moved.low_q_[i][lane];
      end_.low.p[i] = moved.low_p_[i][lane];
    }
    const double change = h + here_.low.t;
    t = end_.state.t = here_.state.t + change;
    end_.low.t = change - (t - here_.state.t);
    return report;
  }

  std::shared_ptr<const Formulas> formulas_;
  std::shared_ptr<const MachineCode> code_;
  StageFormula<lanes> forces_, velocities_;
  PreciseState<dynamic> here_, end_;  // states at both ends of the last step
  double h_ = 0.0;                    // size of the last step
  Vec q_, p_, low_q_, low_p_, change_;
  bool has_slopes_ = false;
  Vec velocity_, force_, acceleration_;  // at both ends of the last step, where they are known
};

}  // namespace

}  // namespace avi::detail
