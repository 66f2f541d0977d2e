#pragma once
#include "avi/core/power.hpp"
#include "avi/core/state.hpp"
#include "avi/solve.hpp"
#include "src/choice/measured.hpp"
#include "src/choice/sketch.hpp"
#include "src/features/bends.hpp"
#include "src/steps/orbit_steps.hpp"
#include "src/steps/steppers.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// The monitors that are candidates for an orbit, and what a sketch of the orbit says about their cost.

namespace avi::detail {

/// Name of the candidate with fixed steps and an explicit method.
inline constexpr std::string_view splitting = "splitting";

/// The energy at the start, \f$H_0\f$, in the formulas of a monitor: a number or, if orbits from many starts
/// share the formulas, a parameter.
struct EnergyAtStart {
  /// The energy as a number.
  EnergyAtStart(double number) : value(number) {}  // NOLINT: implicit, as most energies are numbers
  /// The energy as two parameters, which are late inputs of a graph.
  explicit EnergyAtStart(ExpressionGraph& graph) : node(graph.late_input()), level(graph.late_input()) {}

  double value = 0.0;  ///< \f$H_0\f$, where it is a number.
  int node = -1;       ///< Node of \f$H_0\f$, where it is a parameter.
  int level = -1;      ///< Node of \f$\bar T + \frac12 H_0\f$, likewise.

  /// Values of these parameters. @param kinetic see Choice
  static std::vector<double> parameters(double energy, double kinetic) {
    return {energy, 0.5 * energy + kinetic};
  }
  /// Returns true if the energy is a parameter.
  [[nodiscard]] bool is_open() const { return node >= 0; }
};

/// A monitor of the menu, \f$g = \ell^{-\alpha}\f$, where \f$\ell\f$ is a rate of change that it follows and
/// \f$\alpha = 0\f$ stands for fixed steps. The energy monitors have \f$\ell = \bar T + \frac12(H + H_0) -
/// V(q)\f$ with the mean kinetic energy \f$\bar T\f$. Along the orbit that is the kinetic energy plus its
/// mean; in this form it stays positive in a step whose energy is a little wrong. A monitor given by the user
/// is itself \f$\ell\f$, with \f$\alpha = -1\f$. The method is Gauss collocation, except for the candidate
/// called `splitting`. Programs are made when they are first used.
class Candidate {
 public:
  /// Makes the monitor of this power. @param lively node of \f$\ell\f$, or -1 where it is not needed
  Candidate(std::string its_name, double alpha, std::shared_ptr<const ExpressionGraph> formula, int energy,
            EnergyAtStart energy_at_start, int lively)
      : name(std::move(its_name)), alpha_(alpha), graph_(std::move(formula)), energy_(energy),
        energy_at_start_(energy_at_start), lively_(lively) {}
  /// Makes a monitor whose formulas exist already.
  Candidate(std::string its_name, double alpha, std::shared_ptr<const Formulas> formulas)
      : name(std::move(its_name)), alpha_(alpha), energy_(-1), energy_at_start_(0.0), lively_(-1),
        formulas_(std::move(formulas)) {}

  std::string name;                                 ///< Name in the menu.
  std::vector<int> supplied = {};                   ///< Nodes of the gradient of H, if H supplies its own.
  std::shared_ptr<const Recording> recording = {};  ///< Recording of H with its gradient, if it exists.
  std::shared_ptr<const Switches> switches = {};    ///< Switches of H, at which steps end, if any.
  std::shared_ptr<const Kinks> kinks = {};          ///< Kinks of H, likewise.
  bool brief = false;       ///< Whether its run is over before machine code has paid for itself.
  double outlook = 0.0;     ///< Expected work of all steps, if the longest one has a fixed length in radians.
  double fictive = 0.0;     ///< Fictive time of the sketch with this monitor.
  double longest = 0.0;     ///< Largest product of g and frequency on the sketch.
  int failures = 0;         ///< Number of runs that failed where the last one did.
  double below = infinity;  ///< Step to try after longer ones have failed.
  double between = infinity;  ///< Longest step of use: switches would cut nearly all longer ones.
  double noise = 0.0;         ///< Largest relative error of a force caused by rounding of H, through grad g.
  bool aside = false;  ///< Whether its noise is more than the tolerance allows; it is then tried only if no
                       ///< other keeps that.

  /// Makes the method of this order, which is 6 for the splitting.
  std::unique_ptr<OrbitSteps> steps(int order, SweepSettings sweeps) {
    auto made = std::make_unique<OrbitSteps>(
        splits() ? splitting_steps(formulas()) : gauss_steps(formulas(), order, sweeps), formulas()->n);
    if (switches) made->end_at(*switches, fixed());
    if (kinks) made->end_at(*kinks);
    return made;
  }
  /// Returns true if the method is the explicit splitting.
  [[nodiscard]] bool splits() const { return name == splitting; }
  /// Approximate time, in nanoseconds, of one evaluation of the field with all that belongs to it: a sweep of
  /// order 16 or, for the splitting, a kick and a drift. The latter counts half, as two runs go side by side.
  double price() {
    const auto& f = *formulas();
    const auto size = static_cast<double>(f.forces.operations() + f.velocities.operations());
    const int entries = 2 * static_cast<int>(f.n);
    return splits() ? 0.5 * (20.0 + 0.5 * size + entries) : price_of_sweep(size, entries);
  }
  /// Approximate time of a sweep, measured with one to sixteen degrees of freedom.
  static double price_of_sweep(double operations, int entries) { return 20.0 + operations + 4.0 * entries; }
  /// Returns true if g = 1.
  [[nodiscard]] bool fixed() const { return alpha_ == 0.0; }
  /// The exponent \f$\alpha\f$.
  [[nodiscard]] double alpha() const { return alpha_; }
  /// Node of \f$\ell\f$ in the graph.
  [[nodiscard]] int rate_node() const { return lively_; }
  /// g as a formula of (q, p).
  [[nodiscard]] Formula formula() const {
    ExpressionGraph graph = *graph_;
    const int rate = fixed() ? graph.constant(1.0) : graph.power(lively_, -alpha_);
    return {std::move(graph), rate};
  }
  /// Value of g for this value of \f$\ell\f$.
  [[nodiscard]] double rate_of(double lively) const { return power(lively, -alpha_); }
  /// Value of g at a state.
  double rate_at(const State<dynamic>& z) { return rate_at(z.q.data(), z.p.data()); }
  /// Value of g at (q, p), 2n numbers.
  double rate_at(const double* z) { return fixed() ? 1.0 : rate_at(z, z + formulas()->n); }
  /// Value of g at q and p, n numbers each.
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
  /// Programs that its methods run on, made at the first call.
  const std::shared_ptr<const Formulas>& formulas() {
    if (!formulas_) {
      Formulas made = fixed() && recording ? Formulas::fixed(*recording) : transformed();
      if (brief) made.code = nullptr;
      formulas_ = std::make_shared<const Formulas>(std::move(made));
    }
    return formulas_;
  }
  /// Takes over formulas of the same monitor that exist already.
  void take(std::shared_ptr<const Formulas> formulas) { formulas_ = std::move(formulas); }
  /// Takes over the formula of another monitor. What is known of runs with this one stays.
  void take(Candidate&& other) {
    alpha_ = other.alpha_, energy_ = other.energy_, lively_ = other.lively_;
    graph_ = std::move(other.graph_), energy_at_start_ = other.energy_at_start_;
    formulas_.reset(), room_.reset();
  }

 private:
  /// Makes the programs of \f$\bar H\f$ and g.
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
  /// Makes the programs with late inputs as parameters.
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
  std::optional<Program::Room<double>> room_;  // memory of rate_at()
};

/// Names in the menu, separated by commas.
std::string names_of_monitors();
/// Returns true if there is a monitor of this name.
bool is_monitor(std::string_view name);
/// The monitor of this name, which must exist, outside the menu. @param constants those of the monitors
Candidate candidate(std::string_view name, const OrbitQuestion& question, double energy_at_start,
                    const Choice& constants);
/// The same monitor with formulas that exist already.
Candidate candidate(std::string_view name, const OrbitQuestion& question,
                    std::shared_ptr<const Formulas> formulas);
/// Formulas of a choice for any energy at the start, see EnergyAtStart::parameters().
std::shared_ptr<const Formulas> formulas_of(const Choice& choice, const OrbitQuestion& question);
/// Weights of the monitor `acceleration`, see Choice::accelerations. @param metric diagonal of H_pp
/// @param seen number of coordinates, without time
std::vector<double> accelerations(const Sketch& sketch, const VectorX& metric, Eigen::Index seen);

/// The menu for an orbit, the most promising candidate first. It always contains fixed steps, and the user's
/// own monitor if there is one. @param bends measured along the sketch @param radians phase of the whole
/// orbit @param resting V on the sketch
/// @param metric diagonal of H_pp @param constants those of the monitors; those of `poles` are set where they
/// are needed @param operations number of operations of H with its gradient
std::vector<Candidate> candidates(const OrbitQuestion& question, double energy_at_start, const Sketch& sketch,
                                  const Bends& bends, double radians, const Resting& resting,
                                  const VectorX& metric, Choice& constants, double operations);

}  // namespace avi::detail
