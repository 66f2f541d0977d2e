#pragma once
#include "avi/core/state.hpp"
#include "avi/solve.hpp"
#include "gauss.hpp"
#include "sketch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
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

  /// Another one with the memory of the last step.
  [[nodiscard]] std::unique_ptr<OrbitSteps> clone() const {
    return std::unique_ptr<OrbitSteps>(new OrbitSteps(steps_->clone(), n_));
  }

 private:
  OrbitSteps(std::unique_ptr<GaussSteps> steps, Eigen::Index n)
      : steps_(std::move(steps)), n_(n), z_(2 * n) {}
  std::unique_ptr<GaussSteps> steps_;
  Eigen::Index n_;
  VectorX z_;  // of the step under way
};

/// A rate of change that monitors follow. Of the energy it is \f$\ell = \bar T + \frac12(H + H_0) - H(q,
/// 0)\f$ with the mean kinetic energy \f$\bar T\f$: the kinetic energy and its mean, written such that it
/// stays positive where a step has an energy that is a little wrong. One program for all powers of it.
class Liveliness {
 public:
  /// Of \f$\ell\f$ as a node of a graph.
  Liveliness(const ExpressionGraph& graph, int node)
      : formula_{Recording(graph, node).value_and_gradient()}, inputs_(graph.inputs()) {}
  /// \f$\ell\f$ at z = (q, p), and its gradient for slope() to tell.
  double operator()(const double* z) {
    std::copy(z, z + inputs_, formula_.room.arguments());
    formula_.program.run(formula_.room);
    return formula_.value();
  }
  /// The derivative by entry i of (q, p) at the last point.
  [[nodiscard]] double slope(int i) const { return formula_.partial(i); }

 private:
  RecordedFormula<double> formula_;
  int inputs_;
};

/// A monitor of the menu: \f$g = \ell^{-\alpha}\f$ with the Liveliness, where \f$\alpha = 0\f$ is that of
/// fixed steps, and a given one is its own Liveliness with \f$\alpha = -1\f$. What runs on it is made when it
/// is first used.
class Candidate {
 public:
  /// Of this power.
  Candidate(std::string its_name, double alpha, std::shared_ptr<const ExpressionGraph> formula, int energy,
            double energy_at_start, std::shared_ptr<Liveliness> liveliness, int lively)
      : name(std::move(its_name)), alpha_(alpha), graph_(std::move(formula)), energy_(energy),
        energy_at_start_(energy_at_start), liveliness_(std::move(liveliness)), lively_(lively) {}

  std::string name;                ///< In the menu.
  std::vector<int> supplied = {};  ///< Nodes of the gradient of H, where it has one of its own.
  double outlook = 0.0;            ///< Work of all steps where the longest one in radians is of fixed length.
  double fictive = 0.0;            ///< Fictive time of the sketch.
  double longest = 0.0;            ///< Largest g times frequency on the sketch.
  double noise = 0.0;  ///< Largest relative error of a force that rounding of H makes through grad g.

  /// Gauss collocation of this order.
  std::unique_ptr<OrbitSteps> steps(int order, SweepBounds bounds) {
    return std::make_unique<OrbitSteps>(formulas(), order, bounds);
  }
  /// Operations of a sweep for one lane: those of the formulas, and about what the stages take.
  double operations() {
    const auto& f = *formulas();
    return static_cast<double>(f.forces.operations() + f.velocities.operations()) +
           overhead(graph_->inputs());
  }
  /// The operations of the stages beside the formulas.
  static double overhead(int entries) { return 14.0 * entries; }
  /// g = 1.
  [[nodiscard]] bool fixed() const { return alpha_ == 0.0; }
  /// g at a point, and its gradient for slope() to tell.
  double rate(const double* z) {
    if (fixed()) return 1.0;
    const double lively = (*liveliness_)(z), g = std::pow(lively, -alpha_);
    per_slope_ = -alpha_ * g / lively;
    return g;
  }
  /// g of a state.
  double rate_at(const State<dynamic>& z) {
    if (fixed()) return 1.0;
    VectorX at(z.q.size() + z.p.size());
    at << z.q, z.p;
    return rate(at.data());
  }
  /// The derivative of g by entry i of (q, p) at the last point.
  [[nodiscard]] double slope(int i) const { return fixed() ? 0.0 : per_slope_ * liveliness_->slope(i); }

 private:
  const std::shared_ptr<const Formulas>& formulas() {
    if (!formulas_) {
      ExpressionGraph graph = *graph_;
      int transformed = energy_, rate = graph.constant(1.0);
      if (!fixed()) {
        rate = graph.power(lively_, -alpha_);
        transformed =
            graph.binary(Operation::multiply, rate,
                         graph.binary(Operation::subtract, energy_, graph.constant(energy_at_start_)));
      }
      formulas_ = Formulas::of(graph, transformed, rate, energy_, supplied);
    }
    return formulas_;
  }

  double alpha_;
  std::shared_ptr<const ExpressionGraph> graph_;
  int energy_;
  double energy_at_start_;
  std::shared_ptr<Liveliness> liveliness_;
  int lively_;  // its node
  double per_slope_ = 0.0;
  std::shared_ptr<const Formulas> formulas_;
};

/// The names in the menu, with commas between them.
std::string names_of_monitors();
/// There is a monitor of this name.
bool is_monitor(std::string_view name);
/// The monitor of this name, which there is, on its own. @param constants of the monitors @param timed see
/// and given see OrbitQuestion
Candidate candidate(std::string_view name, const ExpressionGraph& graph, int energy, double energy_at_start,
                    const Choice& constants, bool timed, int given);
/// See Choice::accelerations. @param metric diagonal of H_pp @param seen number of coordinates but time
std::vector<double> accelerations(const Sketch& sketch, const VectorX& metric, Eigen::Index seen);

/// The menu for an orbit, the most promising candidate first; fixed steps are always in it, and a given
/// monitor is where it is positive on the sketch.
/// @param metric diagonal of H_pp @param constants of the monitors
std::vector<Candidate> candidates(const ExpressionGraph& graph, int energy, double energy_at_start,
                                  const Sketch& sketch, const VectorX& metric, const Choice& constants,
                                  bool timed, int given);

}  // namespace avi::detail
