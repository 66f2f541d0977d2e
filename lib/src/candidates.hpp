#pragma once
#include "avi/core/power.hpp"
#include "avi/core/state.hpp"
#include "avi/solve.hpp"
#include "gauss.hpp"
#include "orbit_steps.hpp"
#include "sketch.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// The monitors that are candidates for an orbit, and what a sketch of the orbit says of their cost.

namespace avi::detail {

/// The name of the candidate with fixed steps and an explicit method.
inline constexpr std::string_view splitting = "splitting";

/// The energy at the start, \f$H_0\f$, as a number of the formulas; or, where orbits from many starts are to
/// share them, as their parameters.
struct EnergyAtStart {
  /// A number.
  EnergyAtStart(double number) : value(number) {}  // NOLINT: implicit, as most of them are
  /// Two parameters: late inputs of a graph.
  explicit EnergyAtStart(ExpressionGraph& graph) : node(graph.late_input()), level(graph.late_input()) {}

  double value = 0.0;  ///< \f$H_0\f$, where it is a number.
  int node = -1;       ///< \f$H_0\f$, where it is a parameter.
  int level = -1;      ///< \f$\bar T + \frac12 H_0\f$, likewise.

  /// The values of these parameters. @param kinetic see Choice
  static std::vector<double> parameters(double energy, double kinetic) {
    return {energy, 0.5 * energy + kinetic};
  }
  /// It is a parameter.
  [[nodiscard]] bool is_open() const { return node >= 0; }
};

/// A monitor of the menu: \f$g = \ell^{-\alpha}\f$ with a rate of change that it follows, where \f$\alpha =
/// 0\f$ is that of fixed steps. Of the energy it is \f$\ell = \bar T + \frac12(H + H_0) - V(q)\f$ with the
/// mean kinetic energy \f$\bar T\f$: the kinetic energy and its mean, written such that it stays positive
/// where a step has an energy that is a little wrong. A given monitor is itself \f$\ell\f$, with \f$\alpha =
/// -1\f$. The method is Gauss collocation, but for the candidate called `splitting`. What runs on it is made
/// when it is first used.
class Candidate {
 public:
  /// The monitor of this power. @param lively node of \f$\ell\f$, or -1 where it is not needed
  Candidate(std::string its_name, double alpha, std::shared_ptr<const ExpressionGraph> formula, int energy,
            EnergyAtStart energy_at_start, int lively)
      : name(std::move(its_name)), alpha_(alpha), graph_(std::move(formula)), energy_(energy),
        energy_at_start_(energy_at_start), lively_(lively) {}
  /// A monitor whose formulas are made already.
  Candidate(std::string its_name, double alpha, std::shared_ptr<const Formulas> formulas)
      : name(std::move(its_name)), alpha_(alpha), energy_(-1), energy_at_start_(0.0), lively_(-1),
        formulas_(std::move(formulas)) {}

  std::string name;                ///< In the menu.
  std::vector<int> supplied = {};  ///< Nodes of the gradient of H, where it has one of its own.
  std::shared_ptr<const Recording> recording = {};  ///< That of H with its gradient, where it is made.
  std::shared_ptr<const Switches> switches = {};    ///< At which steps end, if H has any.
  std::shared_ptr<const Kinks> kinks = {};          ///< Likewise.
  bool brief = false;         ///< Its run is over before machine code has paid for itself.
  double outlook = 0.0;       ///< Work of all steps where the longest one in radians is of fixed length.
  double fictive = 0.0;       ///< Fictive time of the sketch.
  double longest = 0.0;       ///< Largest g times frequency on the sketch.
  int failures = 0;           ///< Runs that failed at the place where the last one did.
  double below = infinity;    ///< Where longer steps have failed, a step to try.
  double between = infinity;  ///< Steps that are longer would nearly all be cut by switches.
  double noise = 0.0;         ///< Largest relative error of a force that rounding of H makes through grad g.
  bool aside =
      false;  ///< Its noise is more than the tolerance bears: it waits until no other one keeps that.

  /// The method, of this order, which is 6 for the splitting.
  std::unique_ptr<OrbitSteps> steps(int order, SweepSettings sweeps) {
    auto made = std::make_unique<OrbitSteps>(
        splits() ? splitting_steps(formulas()) : gauss_steps(formulas(), order, sweeps), formulas()->n);
    if (switches) made->end_at(*switches, fixed());
    if (kinks) made->end_at(*kinks);
    return made;
  }
  /// Its method is the explicit splitting.
  [[nodiscard]] bool splits() const { return name == splitting; }
  /// Nanoseconds, about, of one evaluation of the field with all that belongs to it: a sweep of order 16, or
  /// a kick and a drift, of which two runs side by side are counted half.
  double price() {
    const auto& f = *formulas();
    const auto size = static_cast<double>(f.forces.operations() + f.velocities.operations());
    const int entries = 2 * static_cast<int>(f.n);
    return splits() ? 0.5 * (20.0 + 0.5 * size + entries) : price_of_sweep(size, entries);
  }
  /// The price of a sweep: measured from one to sixteen degrees of freedom.
  static double price_of_sweep(double operations, int entries) { return 20.0 + operations + 4.0 * entries; }
  /// g = 1.
  [[nodiscard]] bool fixed() const { return alpha_ == 0.0; }
  /// The power of \f$\ell\f$, negative.
  [[nodiscard]] double alpha() const { return alpha_; }
  /// The node of \f$\ell\f$ in the graph.
  [[nodiscard]] int rate_node() const { return lively_; }
  /// g as a formula of (q, p).
  [[nodiscard]] Formula formula() const {
    ExpressionGraph graph = *graph_;
    const int rate = fixed() ? graph.constant(1.0) : graph.power(lively_, -alpha_);
    return {std::move(graph), rate};
  }
  /// g where \f$\ell\f$ has this value.
  [[nodiscard]] double rate_of(double lively) const { return power(lively, -alpha_); }
  /// g of a state.
  double rate_at(const State<dynamic>& z) { return rate_at(z.q.data(), z.p.data()); }
  /// g at (q, p), 2n entries.
  double rate_at(const double* z) { return fixed() ? 1.0 : rate_at(z, z + formulas()->n); }
  /// The same of n entries each.
  double rate_at(const double* q, const double* p) {
    if (fixed() || formulas()->unit) return 1.0;
    const Program& program = formulas()->rate;
    if (!room_) {
      room_.emplace(program);
      std::ranges::copy(formulas_->parameters, room_->arguments() + 2 * formulas_->n);
    }
    std::copy_n(p, formulas_->n, std::copy_n(q, formulas_->n, room_->arguments()));
    program.run(*room_);
    return program.value(*room_);
  }
  /// The programs that its methods run on, made at the first call.
  const std::shared_ptr<const Formulas>& formulas() {
    if (!formulas_) {
      Formulas made = fixed() && recording ? Formulas::fixed(*recording) : transformed();
      if (brief) made.code = nullptr;
      formulas_ = std::make_shared<const Formulas>(std::move(made));
    }
    return formulas_;
  }
  /// Has formulas of the same monitor that are made already.
  void take(std::shared_ptr<const Formulas> formulas) { formulas_ = std::move(formulas); }

 private:
  /// The programs of \f$\bar H\f$ and g.
  [[nodiscard]] Formulas transformed() const {
    ExpressionGraph graph = *graph_;
    int transformed = energy_, rate = graph.constant(1.0);
    if (!fixed()) {
      rate = graph.power(lively_, -alpha_);
      const int start =
          energy_at_start_.is_open() ? energy_at_start_.node : graph.constant(energy_at_start_.value);
      transformed =
          graph.binary(Operation::multiply, rate, graph.binary(Operation::subtract, energy_, start));
    }
    return energy_at_start_.is_open() ? of_parameters(graph, transformed, rate)
                                      : Formulas::of(std::move(graph), transformed, rate, energy_, supplied);
  }
  /// With late inputs as parameters.
  [[nodiscard]] Formulas of_parameters(const ExpressionGraph& graph, int transformed, int rate) const {
    ExpressionGraph open(graph.inputs() + graph.late_inputs());
    std::vector<int> slopes;
    const auto in_open = [&](int node) { return open.substitute(graph, node); };
    const int all = in_open(transformed);  // first, so that operations keep their order
    for (const int slope : supplied)
      slopes.push_back(in_open(slope));
    const int its_energy = in_open(energy_), its_rate = in_open(rate);
    return Formulas::of(std::move(open), all, its_rate, its_energy, slopes, graph.late_inputs());
  }

  double alpha_;
  std::shared_ptr<const ExpressionGraph> graph_;
  int energy_;
  EnergyAtStart energy_at_start_;
  int lively_;  // node of l
  std::shared_ptr<const Formulas> formulas_;
  std::optional<Program::Room<double>> room_;  // of rate_at()
};

/// V, see Candidate, on a sketch.
struct Resting {
  std::vector<double> energy;  ///< At each sample.
  std::vector<double> forces;  ///< \f$-\partial V/\partial q\f$ there, n for each.
};

/// The names in the menu, with commas between them.
std::string names_of_monitors();
/// There is a monitor of this name.
bool is_monitor(std::string_view name);
/// The monitor of this name, which there is, on its own. @param constants of the monitors
Candidate candidate(std::string_view name, const OrbitQuestion& question, double energy_at_start,
                    const Choice& constants);
/// The same with formulas that are made already.
Candidate candidate(std::string_view name, const OrbitQuestion& question,
                    std::shared_ptr<const Formulas> formulas);
/// The formulas of a choice at any energy at the start, see EnergyAtStart::parameters().
std::shared_ptr<const Formulas> formulas_of(const Choice& choice, const OrbitQuestion& question);
/// See Choice::accelerations. @param metric diagonal of H_pp @param seen number of coordinates but time
std::vector<double> accelerations(const Sketch& sketch, const VectorX& metric, Eigen::Index seen);

/// The menu for an orbit, the most promising candidate first; fixed steps are always in it, and so is a given
/// monitor where there is one. @param radians of the whole orbit @param resting V on the sketch
/// @param metric diagonal of H_pp @param constants of the monitors; those of `poles` are found where they are
/// needed @param operations of H with its gradient
std::vector<Candidate> candidates(const OrbitQuestion& question, double energy_at_start, const Sketch& sketch,
                                  double radians, const Resting& resting, const VectorX& metric,
                                  Choice& constants, double operations);

}  // namespace avi::detail
