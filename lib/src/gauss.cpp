#include "gauss.hpp"

#include "avi/collocation/collocation.hpp"

#include <algorithm>
#include <utility>

namespace avi {
namespace detail {

/// A problem for Collocation whose field is Formulas.
struct GraphProblem {
  static constexpr int dimension = dynamic;  ///< Known at run time.
  struct NoCallable {};                      ///< There is nothing to call.

  std::shared_ptr<const Formulas> formulas;  ///< The field.

  [[nodiscard]] Eigen::Index size() const { return formulas->n; }           ///< n.
  [[nodiscard]] double clock(const VectorX&, double t) const { return t; }  ///< Physical time.
  [[nodiscard]] NoCallable hamiltonian() const { return {}; }               ///< Asked for by name only.
};

}  // namespace detail

/// The field of a GraphProblem at w stages.
template <int w>
class StageField<detail::GraphProblem, w> {
 public:
  static constexpr int n = dynamic;  ///< Known at run time.
  using Scalar = Pack<w>;            ///< One number for each stage.
  using Step = Unknowns<n, w>;       ///< The stages, and where the field goes.

  /// With memory of its own for each program.
  explicit StageField(const detail::GraphProblem& problem)
      : formulas_(problem.formulas), forces_(formulas_->forces), velocities_(formulas_->velocities),
        rates_(formulas_->rate) {}

  /// step.dp = -weight \f$\partial \bar H/\partial q\f$.
  void force(const detail::GraphProblem&, Step& step, const Scalar& weight) {
    field(formulas_->forces, forces_, step, -weight, step.dp);
  }
  /// step.dq = weight \f$\partial \bar H/\partial p\f$.
  void velocity(const detail::GraphProblem&, Step& step, const Scalar& weight) {
    field(formulas_->velocities, velocities_, step, weight, step.dq);
  }
  /// g of the last call of velocity().
  [[nodiscard]] const Scalar& rate(const Step&) {
    if (formulas_->unit) return one_;
    const Scalar* last = velocities_.arguments();
    std::copy(last, last + 2 * formulas_->n, rates_.arguments());
    formulas_->rate.run(rates_);
    return formulas_->rate.value(rates_);
  }

 private:
  static void field(const Program& program, Program::Room<Scalar>& room, const Step& step,
                    const Scalar& weight, Vector<Scalar, n>& out) {
    std::copy(step.q.data(), step.q.data() + step.q.size(), room.arguments());
    std::copy(step.p.data(), step.p.data() + step.p.size(), room.arguments() + step.q.size());
    program.run(room);
    for (int i = 0; i < program.slopes(); ++i)
      out[i] = weight * program.slope(room, i);
  }

  std::shared_ptr<const detail::Formulas> formulas_;
  Program::Room<Scalar> forces_, velocities_, rates_;
  Scalar one_{1.0};
};

namespace detail {
namespace {

/// Collocation behind the interface.
class Steps final : public GaussSteps {
 public:
  Steps(const GraphProblem& problem, int order, SweepBounds bounds)
      : method_(problem, order, {.tolerance = bounds.tolerance, .max_sweeps = bounds.most}),
        state_{.q = VectorX(problem.size()), .p = VectorX(problem.size())} {}

  StepReport step(double* z, double& t, double h) override {
    const Eigen::Index n = state_.q.size();
    std::copy(z, z + n, state_.q.data());
    std::copy(z + n, z + 2 * n, state_.p.data());
    state_.t = t;
    const StepReport report = method_.step(state_, h);
    if (report.ok()) copy(state_, z, t);
    return report;
  }
  void polynomial(double c, double* z, double& t) const override { copy(method_.polynomial(c, 0.0), z, t); }
  void tail(double* z) const override { method_.tail(z, z + state_.q.size()); }
  [[nodiscard]] std::unique_ptr<GaussSteps> clone() const override { return std::make_unique<Steps>(*this); }

 private:
  static void copy(const State<dynamic>& state, double* z, double& t) {
    std::copy(state.q.begin(), state.q.end(), z);
    std::copy(state.p.begin(), state.p.end(), z + state.q.size());
    t = state.t;
  }
  Collocation<GraphProblem> method_;
  State<dynamic> state_;
};

}  // namespace

std::unique_ptr<GaussSteps> gauss_steps(std::shared_ptr<const Formulas> formulas, int order,
                                        SweepBounds bounds) {
  return std::make_unique<Steps>(GraphProblem{std::move(formulas)}, order, bounds);
}

}  // namespace detail
}  // namespace avi
