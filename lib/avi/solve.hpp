#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/state.hpp"

#include <limits>
#include <string>
#include <utility>
#include <vector>

/// @file
/// An orbit from H, a start, an end and a tolerance; everything else is chosen.

namespace avi {

/// Bounds on what a call of solve() may spend. A call that meets one ends with an outcome that says so and
/// keeps the state that it had reached.
struct SolveOptions {
  double seconds = std::numeric_limits<double>::infinity();  ///< Wall-clock time; at least 0.
  bool check = true;            ///< A long run is made twice, so that all of it is compared; see solve().
  long sweeps = 2'000'000'000;  ///< Evaluations of the field at all stages, trials included; at least 1.
};

/// One run that was tried, or tried in vain.
struct SolveTrial {
  std::string monitor;       ///< Name in the menu, see solve().
  int order = 0;             ///< Of the collocation method.
  double h = 0.0;            ///< Fictive step.
  double time = 0.0;         ///< Physical time that it covered.
  long steps = 0;            ///< Taken.
  long sweeps = 0;           ///< Evaluations of all stages.
  double state_error = 0.0;  ///< Of the state at its end, as far as known then; infinite where it failed.
  Outcome outcome = Outcome::ok;  ///< How it ended.
};

/// What was chosen for an orbit. From here on all of it is fixed, and the method is a symplectic map.
struct Choice {
  std::string name = "fixed";  ///< Of the monitor, see solve().
  int order = 0;               ///< Of the collocation method.
  double h = 0.0;              ///< Fictive step.
  double energy_scale = 1.0;   ///< Mean of half of \f$|p\cdot\dot q|\f$: what energy errors are relative to.
  double time = 0.0;           ///< Physical time of the short trials.
  long sweeps = 0;             ///< Evaluations of all stages in all trials.
  long check = 0;              ///< Those of the run with a longer step that goes along the whole orbit.
  std::vector<SolveTrial> trials;  ///< In their order.
};

/// Where an orbit led, how, and how well: the part that does not depend on the dimension.
struct SolutionReport {
  Run run;                       ///< How the run ended; its steps and sweeps.
  Choice choice;                 ///< Monitor, order and step, and the trials that led to them.
  double tolerance = 0.0;        ///< Asked for.
  double state_error = 0.0;      ///< Of the state at the end, see solve(); infinite where nothing is known.
  double energy_error = 0.0;     ///< Largest |H - H_0| of the run, over choice.energy_scale.
  double energy_rounding = 0.0;  ///< Rounding error of one evaluation of H, in the same unit.
  std::string note;              ///< What else a reader should know, in sentences; often empty.

  /// The run reached what was asked for: its end.
  [[nodiscard]] bool ok() const { return run.outcome == Outcome::ok; }
  /// It did, and the error of the state is within ten times the tolerance, as far as two runs with different
  /// steps can tell; that of the energy too, unless rounding of H hides it.
  [[nodiscard]] bool kept() const {
    return ok() && state_error <= 10.0 * tolerance &&
           energy_error <= 10.0 * tolerance + 100.0 * energy_rounding;
  }
  /// What came of it, what was promised, what was chosen, and the trials as a table.
  [[nodiscard]] std::string report() const;
};

/// Where an orbit led, how, and how well.
template <int n>
struct Solution : SolutionReport {
  State<n> state;  ///< At the end, or the last good one; not a number where no run was begun.
};

namespace detail {

/// An orbit that is asked for. Holds no vector of another library, so that it may cross into code that is
/// compiled for another processor.
struct OrbitQuestion {
  ExpressionGraph graph;       ///< Of (q, p).
  int energy;                  ///< Node of H.
  std::vector<double> q, p;    ///< Start.
  double t, t_end, tolerance;  ///< Start, end, tolerance.
  SolveOptions options;        ///< Bounds.
};

/// The answer.
struct OrbitAnswer : SolutionReport {
  std::vector<double> q, p;  ///< State.
  double t = 0.0;            ///< Its time.
};

/// solve() without types that depend on H or n.
OrbitAnswer answer(const OrbitQuestion& question);

}  // namespace detail

/// The orbit of H that is recorded already: solve() below, which says what is promised. Parameters have the
/// values that the formula has.
/// @param hamiltonian from Formula::of_phase() @throws std::invalid_argument for a formula of other
/// arguments, too.
template <int n>
[[nodiscard]] Solution<n> solve(const Formula& hamiltonian, const State<n>& start, double t_end,
                                double tolerance, const SolveOptions& options = {}) {
  require_dimension(start);
  const int count = static_cast<int>(start.q.size());
  require(hamiltonian.inputs() == 2 * count, "Number of arguments of H", hamiltonian.inputs(), "", 2 * count);
  const Formula energy = hamiltonian.with_constants();
  detail::OrbitAnswer found = detail::answer({energy.graph(),
                                              energy.node(),
                                              {start.q.data(), start.q.data() + count},
                                              {start.p.data(), start.p.data() + count},
                                              start.t,
                                              t_end,
                                              tolerance,
                                              options});
  Solution<n> solution{std::move(static_cast<SolutionReport&>(found)), start};
  for (int i = 0; i < count; ++i) {
    solution.state.q[i] = found.q[static_cast<std::size_t>(i)];
    solution.state.p[i] = found.p[static_cast<std::size_t>(i)];
  }
  solution.state.t = found.t;
  return solution;
}

/// Integrates the orbit of H from `start` to the physical time `t_end`.
///
/// The tolerance is that of the state at the end: every coordinate and every momentum is right to about
/// `tolerance` times the range through which it moves. SolutionReport::state_error says what came of it: the
/// difference to a second run with a longer step, reduced by the order of the method. Runs of more than some
/// sixty turns find their step from the errors of the first sixteenth, which grow linearly in time where
/// motion is regular; without SolveOptions::check that is all there is of the second run, at a half of the
/// price. Where the motion does not allow the tolerance (chaos, rounding, a wall thinner than a step), kept()
/// is false and report() says why.
///
/// The method is Gauss collocation with constant steps in the fictive time of one of these monitors,
/// symplectic but for the last, shorter step that ends at t_end:
///
/// | name | g |
/// | --- | --- |
/// | fixed | 1 |
/// | energy, energy^1.5 | \f$(\bar T + \frac12(H + H_0) - H(q, 0))^{-\alpha}\f$, \f$\alpha = 1\f$ or 3/2 |
///
/// Monitor, order and step are those that take the least work in short trials. The same input gives the same
/// choice; units and masses do not matter. H is called once, with a scalar that records what is done to it.
/// @throws std::invalid_argument where H is not finite at the start, or for a time, tolerance or bound out of
/// range.
template <class H, int n>
[[nodiscard]] Solution<n> solve(const H& hamiltonian, const State<n>& start, double t_end, double tolerance,
                                const SolveOptions& options = {}) {
  require_dimension(start);
  return solve(Formula::of_phase<n>(hamiltonian, start.q.size()), start, t_end, tolerance, options);
}

}  // namespace avi
