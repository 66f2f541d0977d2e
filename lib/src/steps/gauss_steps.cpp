#include "src/steps/builds.hpp"

#include "avi/collocation/gauss_step.hpp"
#include "src/steps/splitting_steps.hpp"

#include <algorithm>
#include <utility>

// This file is compiled once for each set of instructions, each time under another name; builds.cpp chooses.
#ifndef AVI_GAUSS_STEPS
#define AVI_GAUSS_STEPS gauss_steps_portable
#define AVI_SPLITTING_STEPS splitting_steps_portable
#endif

namespace avi::detail {

namespace {

/// The field of Formulas at w stages.
template <int n, int w>
class FormulaField final : public StageField<n, w> {
  using Base = StageField<n, w>;

 public:
  using typename Base::Scalar, typename Base::Step;

  /// Makes a field with its own memory for each program.
  explicit FormulaField(std::shared_ptr<const Formulas> formulas)
      : formulas_(std::move(formulas)), code_(machine_code<w>(*formulas_)),
        forces_(formulas_->forces, formulas_->parameters, code_.get(), 0),
        velocities_(formulas_->velocities, formulas_->parameters, code_.get(), 1),
        rates_(formulas_->rate, formulas_->parameters, formulas_->unit ? nullptr : code_.get(), 2) {}

  void forces(Step& step, const Scalar& weight) override {
    forces_.run(step.q, step.p, -weight, step.dp.data());
  }
  void velocities(Step& step, const Scalar& weight) override {
    velocities_.run(step.q, step.p, weight, step.dq.data());
  }
  const Scalar& rate(const Step& step) override {
    if (!formulas_->unit) rates_.run(step.q, step.p, rate_, &rate_);
    return rate_;
  }
  [[nodiscard]] double clock(const Vector<double, n>&, double t) const override { return t; }
  [[nodiscard]] std::unique_ptr<Base> clone() const override { return std::make_unique<FormulaField>(*this); }

 private:
  std::shared_ptr<const Formulas> formulas_;
  std::shared_ptr<const MachineCode> code_;
  StageFormula<w> forces_, velocities_, rates_;
  Scalar rate_{1.0};
};

/// Gauss collocation as a Stepper.
template <int n, int w>
class Steps final : public Stepper {
 public:
  Steps(const std::shared_ptr<const Formulas>& formulas, const GaussRule& rule, SweepSettings sweeps)
      : step_(std::make_unique<FormulaField<n, w>>(formulas), formulas->n, rule, sweeps),
        state_{.q = Vector<double, n>::Zero(formulas->n), .p = Vector<double, n>::Zero(formulas->n)} {}

  StepReport step(double* z, double& t, double h) override {
    const Eigen::Index size = state_.q.size();
    std::copy(z, z + size, state_.q.data());
    std::copy(z + size, z + 2 * size, state_.p.data());
    state_.t = t;
    const StepReport report = step_.step(state_, h);
    if (report.ok()) copy(state_, z, t);
    return report;
  }
  void polynomial(double c, double* z, double& t) const override { copy(step_.polynomial(c), z, t); }
  void tail(double* z, int) const override { step_.tail(z, z + state_.q.size()); }
  [[nodiscard]] std::unique_ptr<Stepper> clone() const override { return std::make_unique<Steps>(*this); }

 private:
  static void copy(const State<n>& state, double* z, double& t) {
    std::copy(state.q.begin(), state.q.end(), z);
    std::copy(state.p.begin(), state.p.end(), z + state.q.size());
    t = state.t;
  }
  GaussStep<n, w> step_;
  State<n> state_;
};

template <int n>
std::unique_ptr<Stepper> steps(const std::shared_ptr<const Formulas>& formulas, int order,
                               SweepSettings sweeps) {
  const GaussRule& rule = collocation_rule(order, 16, sweeps);
  if (order > 8) return std::make_unique<Steps<n, 8>>(formulas, rule, sweeps);
  return std::make_unique<Steps<n, 4>>(formulas, rule, sweeps);
}

}  // namespace

std::unique_ptr<Stepper> AVI_GAUSS_STEPS(std::shared_ptr<const Formulas> formulas, int order,
                                         SweepSettings sweeps) {
  switch (formulas->n) {
  case 1:
    return steps<1>(formulas, order, sweeps);
  case 2:
    return steps<2>(formulas, order, sweeps);
  case 3:
    return steps<3>(formulas, order, sweeps);
  case 4:
    return steps<4>(formulas, order, sweeps);
  default:
    return steps<dynamic>(formulas, order, sweeps);
  }
}

std::unique_ptr<Stepper> AVI_SPLITTING_STEPS(std::shared_ptr<const Formulas> formulas) {
  return std::make_unique<SplittingSteps>(std::move(formulas));
}

}  // namespace avi::detail
