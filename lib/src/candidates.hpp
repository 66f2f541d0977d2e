#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/core/state.hpp"
#include "gauss.hpp"
#include "sketch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// The monitors that are candidates for an orbit, and what a sketch of the orbit says of their cost.

namespace avi::detail {

/// Gauss collocation of states.
class OrbitSteps {
 public:
  /// See gauss_steps().
  OrbitSteps(const std::shared_ptr<const Formulas>& formulas, int order, SweepBounds bounds)
      : steps_(gauss_steps(formulas, order, bounds)), n_(formulas->n), z_(2 * n_) {}

  /// Advances z by the fictive step h, unless the report says another outcome than ok.
  StepReport step(State<dynamic>& z, double h) {
    z_ << z.q, z.p;
    const StepReport report = steps_->step(z_.data(), z.t, h);
    z.q = z_.head(n_);
    z.p = z_.tail(n_);
    return report;
  }
  /// The collocation polynomial of the last step at its fraction c.
  [[nodiscard]] State<dynamic> polynomial(double c) const {
    VectorX z(2 * n_);
    State<dynamic> state;
    steps_->polynomial(c, z.data(), state.t);
    state.q = z.head(n_);
    state.p = z.tail(n_);
    return state;
  }

 private:
  std::unique_ptr<GaussSteps> steps_;
  Eigen::Index n_;
  VectorX z_;  // of the step under way
};

/// A monitor of the menu with everything that runs on it, made when it is first used.
class Candidate {
 public:
  /// Of \f$\bar H\f$ and g as nodes of a graph.
  Candidate(std::string its_name, std::shared_ptr<const ExpressionGraph> graph, int transformed, int rate)
      : name(std::move(its_name)), graph_(std::move(graph)), transformed_(transformed), rate_(rate) {}

  std::string name;      ///< In the menu.
  double work = 1.0;     ///< Operations of its field and its monitor, a guess before it is built.
  double outlook = 0.0;  ///< Work of all steps where the longest one in radians is of fixed length.
  double fictive = 0.0;  ///< Fictive time of the sketch.
  double noise = 0.0;    ///< Largest relative error of a force that rounding of H makes through grad g.

  /// Gauss collocation of order 8 or 16.
  OrbitSteps& solver(int order) {
    auto& made = solvers_[order > 8];
    if (!made) made = std::make_unique<OrbitSteps>(formulas(), order, SweepBounds{.most = 60});
    return *made;
  }
  /// A second one for steps beside those of a run.
  OrbitSteps& beside(int order) {
    auto& made = beside_[order > 8];
    if (!made) made = std::make_unique<OrbitSteps>(formulas(), order, SweepBounds{});
    return *made;
  }
  /// Operations of a sweep for one lane.
  double operations() {
    const auto& f = *formulas();
    return static_cast<double>(f.forces.operations() + f.velocities.operations());
  }
  /// g = 1.
  [[nodiscard]] bool fixed() const { return graph_->is(rate_, 1.0); }
  /// g at a point, and its gradient for slope() to tell.
  double rate(const double* z) {
    if (fixed()) return 1.0;
    if (!rates_)
      rates_ = std::make_unique<RecordedFormula<double>>(Recording(*graph_, rate_).value_and_gradient());
    std::copy(z, z + graph_->inputs(), rates_->room.arguments());
    rates_->program.run(rates_->room);
    return rates_->value();
  }
  /// The derivative of g by entry i of (q, p) at the last point.
  [[nodiscard]] double slope(int i) const { return rates_->partial(i); }

 private:
  const std::shared_ptr<const Formulas>& formulas() {
    if (!formulas_) formulas_ = Formulas::of(*graph_, transformed_, rate_);
    return formulas_;
  }

  std::shared_ptr<const ExpressionGraph> graph_;
  int transformed_, rate_;
  std::shared_ptr<const Formulas> formulas_;
  std::unique_ptr<RecordedFormula<double>> rates_;
  std::array<std::unique_ptr<OrbitSteps>, 2> solvers_, beside_;
};

/// The graph of a formula of (q, p) with all momenta put to zero, in the same graph.
int at_rest(ExpressionGraph& graph, int energy);

/// The menu for an orbit, the most promising candidate first; fixed steps are always in it.
/// @param metric diagonal of H_pp @param kinetic mean kinetic energy, or no number above 0
std::vector<Candidate> candidates(const ExpressionGraph& graph, int energy, double energy_at_start,
                                  const VectorX& start, const Sketch& sketch, const VectorX& metric,
                                  double kinetic);

}  // namespace avi::detail
