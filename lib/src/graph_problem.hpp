#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/collocation/collocation.hpp"

#include <algorithm>
#include <memory>
#include <utility>

/// @file
/// A transformed problem as programs: every Hamiltonian with every monitor is of one type.

namespace avi::detail {

/// The programs of \f$\bar H = g\,(H - H_0)\f$, made once and shared by all methods that run on them.
struct Formulas {
  Program forces;      ///< \f$\partial\bar H/\partial q\f$.
  Program velocities;  ///< \f$\partial\bar H/\partial p\f$.
  Program rate;        ///< g; not used where `unit`.
  bool unit = false;   ///< g = 1.
  Eigen::Index n = 0;  ///< Degrees of freedom.

  /// Of \f$\bar H\f$ and g as nodes of one graph of (q, p).
  static std::shared_ptr<const Formulas> of(const ExpressionGraph& graph, int transformed, int rate) {
    const int n = graph.inputs() / 2;
    const Recording recording(graph, transformed);
    return std::make_shared<const Formulas>(Formulas{.forces = recording.gradient(0, n),
                                                     .velocities = recording.gradient(n, n),
                                                     .rate = Recording(graph, rate).value(),
                                                     .unit = graph.is(rate, 1.0),
                                                     .n = n});
  }
};

/// A problem for Collocation whose field is Formulas.
struct GraphProblem {
  static constexpr int dimension = dynamic;  ///< Known at run time.
  struct NoCallable {};                      ///< There is nothing to call.

  std::shared_ptr<const Formulas> formulas;  ///< The field.

  [[nodiscard]] Eigen::Index size() const { return formulas->n; }           ///< n.
  [[nodiscard]] double clock(const VectorX&, double t) const { return t; }  ///< Physical time.
  [[nodiscard]] NoCallable hamiltonian() const { return {}; }               ///< Asked for by name only.
};

}  // namespace avi::detail

namespace avi {

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

}  // namespace avi
