#include "avi/collocation/collocation.hpp"
#include "gauss_builds.hpp"

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

  [[nodiscard]] Eigen::Index size() const { return formulas->n; }  ///< n.
  [[nodiscard]] double clock(const Vector<double, degrees>&, double t) const {
    return t;
  }                                                            ///< Physical time.
  [[nodiscard]] NoCallable hamiltonian() const { return {}; }  ///< Asked for by name only.
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
        rates_(formulas_->rate) {}

  /// step.dp = -weight \f$\partial \bar H/\partial q\f$.
  void force(const Problem&, Step& step, const Scalar& weight) {
    field(formulas_->forces, forces_, step, -weight, step.dp);
  }
  /// step.dq = weight \f$\partial \bar H/\partial p\f$.
  void velocity(const Problem&, Step& step, const Scalar& weight) {
    field(formulas_->velocities, velocities_, step, weight, step.dq);
  }
  /// g at the stages.
  [[nodiscard]] const Scalar& rate(const Step& step) {
    if (formulas_->unit) return one_;
    arguments(step, rates_);
    formulas_->rate.run(rates_);
    return formulas_->rate.value(rates_);
  }

 private:
  using Room = Program::Room<Scalar>;
  static void arguments(const Step& step, Room& room) {
    Scalar* const z = room.arguments();
    const Eigen::Index size = step.q.size();
    for (Eigen::Index i = 0; i < size; ++i) {
      z[i] = step.q[i];
      z[size + i] = step.p[i];
    }
  }
  static void field(const Program& program, Room& room, const Step& step, const Scalar& weight,
                    Vector<Scalar, n>& out) {
    arguments(step, room);
    program.run(room);
    for (Eigen::Index i = 0; i < out.size(); ++i)
      out[i] = weight * program.slope(room, static_cast<int>(i));
  }

  std::shared_ptr<const detail::Formulas> formulas_;
  Room forces_, velocities_, rates_;
  Scalar one_{1.0};
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
  return std::make_unique<Steps<n>>(GraphProblem<n>{std::move(formulas)}, order, bounds);
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
