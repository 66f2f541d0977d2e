#include "avi/collocation/gauss_step.hpp"
#include "gauss_builds.hpp"
#include "pack_functions.hpp"

#include <algorithm>
#include <array>
#include <utility>

// Compiled once for each set of instructions, each time under a name of its own; gauss.cpp chooses.
#ifndef AVI_GAUSS_STEPS
#define AVI_GAUSS_STEPS gauss_steps_portable
#endif

namespace avi::detail {

namespace {

/// The machine that this file is compiled for makes code at run time.
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
constexpr bool makes_code = true, has_avx512 = true;
#elif defined(__AVX2__)
constexpr bool makes_code = true, has_avx512 = false;
#else
constexpr bool makes_code = false, has_avx512 = false;
#endif

/// A program at packs of w numbers.
template <int w>
class StageFormula {
 public:
  explicit StageFormula(const Program& program) : program_(&program), room_(program) {}

  /// out = factor times its derivatives, or its value where it has none.
  template <class Vec>
  [[gnu::always_inline]] void run(const Vec& q, const Vec& p, const Pack<w>& factor, Pack<w>* out) {
    if (code)
      code(number(q.data()), number(p.data()), number(&factor), number(out));
    else
      interpret(q, p, factor, out);
  }
  MachineCode::Function code = nullptr;  ///< Of this program, once there is one.

 private:
  static const double* number(const Pack<w>* x) { return reinterpret_cast<const double*>(x); }
  static double* number(Pack<w>* x) { return reinterpret_cast<double*>(x); }
  template <class Vec>
  [[gnu::noinline]] void interpret(const Vec& q, const Vec& p, const Pack<w>& factor, Pack<w>* out) {
    Pack<w>* const z = room_.arguments();
    const Eigen::Index size = q.size();
    for (Eigen::Index i = 0; i < size; ++i) {
      z[i] = q[i];
      z[size + i] = p[i];
    }
    program_->run(room_);
    if (program_->slopes() == 0) out[0] = program_->value(room_);
    for (int i = 0; i < program_->slopes(); ++i)
      out[i] = factor * program_->slope(room_, i);
  }

  const Program* program_;
  Program::Room<Pack<w>> room_;
};

/// The field of Formulas at w stages.
template <int n, int w>
class FormulaField final : public StageField<n, w> {
  using Base = StageField<n, w>;

 public:
  using typename Base::Scalar, typename Base::Step;

  /// With memory of its own for each program.
  FormulaField(std::shared_ptr<const Formulas> formulas, int code_from_step)
      : formulas_(std::move(formulas)), forces_(formulas_->forces), velocities_(formulas_->velocities),
        rates_(formulas_->rate), steps_left_(code_from_step) {
    use_machine_code(steps_left_ <= 0);
  }

  void forces(Step& step, const Scalar& weight) override {
    forces_.run(step.q, step.p, -weight, step.dp.data());
  }
  void velocities(Step& step, const Scalar& weight) override {
    velocities_.run(step.q, step.p, weight, step.dq.data());
  }
  const Scalar& rate(const Step& step) override {
    if (steps_left_ > 0 && --steps_left_ == 0) use_machine_code(true);
    if (!formulas_->unit) rates_.run(step.q, step.p, rate_, &rate_);
    return rate_;
  }
  [[nodiscard]] double clock(const Vector<double, n>&, double t) const override { return t; }
  [[nodiscard]] std::unique_ptr<Base> clone() const override { return std::make_unique<FormulaField>(*this); }

 private:
  void use_machine_code(bool make) {
    if constexpr (makes_code) {
      const Program* const programs[] = {&formulas_->forces, &formulas_->velocities, &formulas_->rate};
      code_ = formulas_->code->of({programs, formulas_->unit ? 2u : 3u},
                                  {.lanes = w, .avx512 = has_avx512, .functions = pack_functions<w>()}, make);
      if (!code_) return;
      forces_.code = (*code_)[0];
      velocities_.code = (*code_)[1];
      if (!formulas_->unit) rates_.code = (*code_)[2];
    }
  }

  std::shared_ptr<const Formulas> formulas_;
  std::shared_ptr<const MachineCode> code_;
  StageFormula<w> forces_, velocities_, rates_;
  Scalar rate_{1.0};
  int steps_left_;  // until there is machine code
};

/// Gauss collocation behind the interface.
template <int n, int w>
class Steps final : public GaussSteps {
 public:
  Steps(const std::shared_ptr<const Formulas>& formulas, const GaussRule& rule, SweepBounds bounds)
      : step_(std::make_unique<FormulaField<n, w>>(formulas, bounds.code_from_step), formulas->n, rule,
              settings(bounds)),
        state_{.q = Vector<double, n>::Zero(formulas->n), .p = Vector<double, n>::Zero(formulas->n)} {}

  static SweepSettings settings(SweepBounds bounds) {
    return {.tolerance = bounds.tolerance, .max_sweeps = bounds.most};
  }
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
  void tail(double* z) const override { step_.tail(z, z + state_.q.size()); }
  [[nodiscard]] std::unique_ptr<GaussSteps> clone() const override { return std::make_unique<Steps>(*this); }

 private:
  static void copy(const State<n>& state, double* z, double& t) {
    std::copy(state.q.begin(), state.q.end(), z);
    std::copy(state.p.begin(), state.p.end(), z + state.q.size());
    t = state.t;
  }
  GaussStep<n, w> step_;
  State<n> state_;
};

/// The rules of all orders, made once.
const GaussRule& known_rule(int order, SweepSettings settings) {
  require_collocation(order, 16, settings);
  static const std::array<GaussRule, 8> rules{GaussRule(1), GaussRule(2), GaussRule(3), GaussRule(4),
                                              GaussRule(5), GaussRule(6), GaussRule(7), GaussRule(8)};
  return rules[static_cast<std::size_t>(order / 2 - 1)];
}

template <int n>
std::unique_ptr<GaussSteps> steps(const std::shared_ptr<const Formulas>& formulas, int order,
                                  SweepBounds bounds) {
  const GaussRule& rule = known_rule(order, Steps<n, 4>::settings(bounds));
  if (order > 8) return std::make_unique<Steps<n, 8>>(formulas, rule, bounds);
  return std::make_unique<Steps<n, 4>>(formulas, rule, bounds);
}

}  // namespace

std::unique_ptr<GaussSteps> AVI_GAUSS_STEPS(std::shared_ptr<const Formulas> formulas, int order,
                                            SweepBounds bounds) {
  switch (formulas->n) {
  case 1:
    return steps<1>(formulas, order, bounds);
  case 2:
    return steps<2>(formulas, order, bounds);
  case 3:
    return steps<3>(formulas, order, bounds);
  case 4:
    return steps<4>(formulas, order, bounds);
  default:
    return steps<dynamic>(formulas, order, bounds);
  }
}

}  // namespace avi::detail
