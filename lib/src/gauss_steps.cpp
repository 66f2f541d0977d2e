#include "avi/collocation/collocation.hpp"
#include "gauss_builds.hpp"
#include "pack_functions.hpp"

#include <algorithm>
#include <utility>

// Compiled once for each set of instructions, each time under a name of its own; gauss.cpp chooses.
#ifndef AVI_GAUSS_STEPS
#define AVI_GAUSS_STEPS gauss_steps_portable
#endif

namespace avi {
namespace detail {
namespace {

/// A problem for Collocation whose field is Formulas. @tparam degrees n, or avi::dynamic
template <int degrees>
struct GraphProblem {
  static constexpr int dimension = degrees;  ///< n.
  struct NoCallable {};                      ///< There is nothing to call.

  std::shared_ptr<const Formulas> formulas;  ///< The field.
  int code_from_step = 0;                    ///< See SweepBounds.

  [[nodiscard]] Eigen::Index size() const { return formulas->n; }  ///< n.
  [[nodiscard]] double clock(const Vector<double, degrees>&, double t) const {
    return t;
  }                                                            ///< Physical time.
  [[nodiscard]] NoCallable hamiltonian() const { return {}; }  ///< Asked for by name only.
};

}  // namespace
}  // namespace detail

namespace detail {
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

}  // namespace
}  // namespace detail

/// The field of a GraphProblem at w stages.
template <int degrees, int w>
class StageField<detail::GraphProblem<degrees>, w> {
 public:
  static constexpr int n = degrees;               ///< Or avi::dynamic.
  using Problem = detail::GraphProblem<degrees>;  ///< What it is the field of.
  using Scalar = Pack<w>;                         ///< One number for each stage.
  using Step = Unknowns<n, w>;                    ///< The stages, and where the field goes.

  /// With memory of its own for each program.
  explicit StageField(const Problem& problem)
      : formulas_(problem.formulas), forces_(formulas_->forces), velocities_(formulas_->velocities),
        rates_(formulas_->rate), steps_left_(problem.code_from_step) {
    use_machine_code(steps_left_ <= 0);
  }

  /// step.dp = -weight \f$\partial \bar H/\partial q\f$.
  void force(const Problem&, Step& step, const Scalar& weight) {
    forces_.run(step.q, step.p, -weight, step.dp.data());
  }
  /// step.dq = weight \f$\partial \bar H/\partial p\f$.
  void velocity(const Problem&, Step& step, const Scalar& weight) {
    velocities_.run(step.q, step.p, weight, step.dq.data());
  }
  /// g at the stages of a step that is solved.
  [[nodiscard]] const Scalar& rate(const Step& step) {
    if (steps_left_ > 0 && --steps_left_ == 0) use_machine_code(true);
    if (!formulas_->unit) rates_.run(step.q, step.p, rate_, &rate_);
    return rate_;
  }

 private:
  void use_machine_code(bool make) {
    if constexpr (detail::makes_code && (w == 4 || w == 8)) {
      const Program* const programs[] = {&formulas_->forces, &formulas_->velocities, &formulas_->rate};
      code_ = formulas_->code->of(
          {programs, formulas_->unit ? 2u : 3u},
          {.lanes = w, .avx512 = detail::has_avx512, .functions = detail::pack_functions<w>()}, make);
      if (!code_) return;
      forces_.code = (*code_)[0];
      velocities_.code = (*code_)[1];
      if (!formulas_->unit) rates_.code = (*code_)[2];
    }
  }

  std::shared_ptr<const detail::Formulas> formulas_;
  std::shared_ptr<const detail::MachineCode> code_;
  detail::StageFormula<w> forces_, velocities_, rates_;
  Scalar rate_{1.0};
  int steps_left_;  // until there is machine code
};

namespace detail {
namespace {

/// Collocation behind the interface.
template <int n>
class Steps final : public GaussSteps {
 public:
  Steps(const GraphProblem<n>& problem, int order, SweepBounds bounds)
      : method_(problem, order, {.tolerance = bounds.tolerance, .max_sweeps = bounds.most}),
        state_{.q = Vector<double, n>::Zero(problem.size()), .p = Vector<double, n>::Zero(problem.size())} {}

  StepReport step(double* z, double& t, double h) override {
    const Eigen::Index size = state_.q.size();
    std::copy(z, z + size, state_.q.data());
    std::copy(z + size, z + 2 * size, state_.p.data());
    state_.t = t;
    const StepReport report = method_.step(state_, h);
    if (report.ok()) copy(state_, z, t);
    return report;
  }
  void polynomial(double c, double* z, double& t) const override { copy(method_.polynomial(c, 0.0), z, t); }
  void tail(double* z) const override { method_.tail(z, z + state_.q.size()); }
  [[nodiscard]] std::unique_ptr<GaussSteps> clone() const override { return std::make_unique<Steps>(*this); }

 private:
  static void copy(const State<n>& state, double* z, double& t) {
    std::copy(state.q.begin(), state.q.end(), z);
    std::copy(state.p.begin(), state.p.end(), z + state.q.size());
    t = state.t;
  }
  Collocation<GraphProblem<n>> method_;
  State<n> state_;
};

template <int n>
std::unique_ptr<GaussSteps> steps(std::shared_ptr<const Formulas> formulas, int order, SweepBounds bounds) {
  return std::make_unique<Steps<n>>(GraphProblem<n>{std::move(formulas), bounds.code_from_step}, order,
                                    bounds);
}

}  // namespace

std::unique_ptr<GaussSteps> AVI_GAUSS_STEPS(std::shared_ptr<const Formulas> formulas, int order,
                                            SweepBounds bounds) {
  switch (formulas->n) {
  case 1:
    return steps<1>(std::move(formulas), order, bounds);
  case 2:
    return steps<2>(std::move(formulas), order, bounds);
  case 3:
    return steps<3>(std::move(formulas), order, bounds);
  case 4:
    return steps<4>(std::move(formulas), order, bounds);
  default:
    return steps<dynamic>(std::move(formulas), order, bounds);
  }
}

}  // namespace detail
}  // namespace avi
