#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/state.hpp"

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// solve(): the orbit of a Hamiltonian H to a given tolerance, with monitor, order and step chosen for it.

namespace avi {

/// The mass of a test particle. It cannot be 0, because H divides by it. A power of two makes p / m the exact
/// velocity, and the value is so small that the attraction of the particle on other bodies lies below their
/// rounding error, in any units.
inline constexpr double massless = 0x1p-200;

namespace detail {
/// True where F is called with a time, as f(q, t, p).
template <class F, int n = dynamic>
constexpr bool takes_time() {
  using Vec = RecordedVector<n>;
  return std::is_invocable_v<const F&, const Vec&, const Recorded&, const Vec&>;
}
/// The function that records g(q), g(q, p) or g(q, t, p), for a given number n of degrees of freedom.
template <class G>
std::function<Formula(int)> recorder(G g) {
  return [g = std::move(g)](int n) {
    if constexpr (std::is_same_v<G, Formula>)
      return g.with_constants();
    else if constexpr (takes_time<G>())
      return Formula::of_phase_and_time(g, n);
    else if constexpr (std::is_invocable_v<const G&, const RecordedVector<>&>)
      return Formula::of_phase([&](const auto& q, const auto&) { return recorded_call(g, q); }, n);
    else
      return Formula::of_phase(g, n);
  };
}
}  // namespace detail

/// Which zeros of an event function count, and whether the last of them ends the run.
struct EventRules {
  int direction = 0;  ///< 1 for zeros where g rises as the run goes, -1 where it falls, 0 for both.
  long count = 0;     ///< Number of zeros to find; 0 for all of them, or for the first one if `stop` is set.
  bool stop = false;  ///< The run ends at the last of these zeros, with Outcome::ok.
};

/// An event g = 0 to be located along an orbit; made by when().
struct SolveEvent {
  SolveEvent() = default;  ///< An event without a function, which solve() refuses.
  /// An event from the function that records g, and the rules.
  SolveEvent(std::function<Formula(int)> its_g, EventRules its_rules)
      : g(std::move(its_g)), rules(its_rules) {}
  /// Rejects a bare function at compile time; when() turns it into an event.
  template <class G>
  requires(!std::is_same_v<G, SolveEvent> && !std::is_same_v<G, std::vector<SolveEvent>>)
      SolveEvent(const G&) {
    static_assert(std::is_void_v<G>, "An event is made by when(): {.events = {avi::when(g)}}.");
  }

  std::function<Formula(int)> g;  ///< Records g(q, p) or g(q, t, p) for n degrees of freedom.
  EventRules rules;               ///< Which zeros count.
};

/// An event for SolveOptions::events: the zeros of g(q), g(q, p) or g(q, t, p) along an orbit. Like H, g is
/// called once, with vectors of a recording scalar. Then g is sampled at nine points of every step, and at up
/// to a thousand where no smooth curve fits the samples. A run in which g changes sign more often than the
/// samples can resolve ends as not_converged. Near zero, the slopes of g at neighbouring samples show whether
/// it turns between them, so that most zeros close together are found; some may be missed. Where g nearly
/// touches zero, further steps decide on which side it stays. A zero at the start does not count. As in
/// Event, a change of sign by a jump or a pole ends the run as not_converged, and a NaN as non_finite.
template <class G>
[[nodiscard]] SolveEvent when(G g, EventRules rules = {}) {
  return {detail::recorder(std::move(g)), rules};
}

/// The monitor g of a run, \f$dt = g\,d\tau\f$: a name from the menu of solve(), or a positive, smooth g(q),
/// g(q, p) or g(q, t, p) of your own, called once, as H is; its name is then "given".
struct SolveMonitor {
  SolveMonitor() = default;  ///< Leaves the choice to solve().
  ///@{

  /// The monitor of this name.
  SolveMonitor(std::string its_name) : name(std::move(its_name)) {}
  SolveMonitor(const char* its_name) : name(its_name) {}
  ///@}
  /// A monitor of your own.
  template <class G>
  requires(!std::is_convertible_v<G, std::string> && !std::is_same_v<G, SolveMonitor>) SolveMonitor(G its_g)
      : name("given"), g(detail::recorder(std::move(its_g))) {}

  std::string name = {};               ///< Name of the monitor; empty to have it chosen.
  std::function<Formula(int)> g = {};  ///< Records your own monitor for n degrees of freedom.
};

/// The phase of a call of solve().
enum class SolvePhase {
  choosing,  ///< Choosing monitor, order and step; the two runs that are compared are part of this.
  running    ///< The run whose states are delivered, where output along the orbit was asked for.
};

/// How far a call of solve() has come, for SolveOptions::progress.
struct SolveProgress {
  SolvePhase phase = SolvePhase::choosing;  ///< Phase of the call.
  double t = 0.0;                           ///< Physical time of the run under way.
  double fraction = 0.0;                    ///< Share of the time span that this run has covered, in [0, 1].
  long steps = 0;                           ///< Steps of that run.
  long sweeps = 0;                          ///< Sweeps of the whole call so far.
  double seconds = 0.0;                     ///< Seconds since the call began.
};

/// Options of solve(): what else to compute, bounds on the cost, and settings to fix instead of having them
/// chosen. A call that meets a bound ends with an outcome that says so, and keeps what it has reached.
struct SolveOptions {
  double seconds = std::numeric_limits<double>::infinity();  ///< Bound on the wall-clock time; at least 0.
  bool check = true;            ///< Compare two runs, over the whole time or until they part; see solve().
  long sweeps = 2'000'000'000;  ///< Bound on field evaluations at all stages, trials included; at least 1.
  long steps = std::numeric_limits<long>::max();  ///< Bound on the steps of one run; at least 1.
  int order = 0;                                  ///< Order of the method: 2, 4, ... 16; 0 to have it chosen.
  SolveMonitor monitor = {};  ///< A name from the menu of solve(), or your own function; see SolveMonitor.
  double h = 0.0;             ///< Fictive step for that monitor, positive; 0 to have it chosen.
  bool dense = false;         ///< Allows the solution to be evaluated at any time of the run.
  std::vector<SolveEvent> events = {};  ///< Events to find along the orbit; see when().
  /// Called about twenty times a second from the thread that called solve(); returning false ends the call as
  /// stopped. An exception leaves solve(), which then has changed only the checkpoint file.
  std::function<bool(const SolveProgress&)> progress = {};
  /// File in which the run is saved for resume() until it is complete; empty for none. The method restarts
  /// every 4096 steps, at the cost of a rounding error each time, so that a resumed run has the same bits.
  /// The saved run is the one that delivers the states. One run before it, or two with `check`, also go to
  /// the end, without a file of their own; a bound or a cancellation then saves only what was chosen by then.
  std::string checkpoint = {};
  double checkpoint_seconds = 60.0;  ///< Seconds between writes of the file; at least 0.
};

/// One trial run, successful or not.
struct SolveTrial {
  std::string monitor;            ///< Name of its monitor in the menu of solve().
  int order = 0;                  ///< Order of the method.
  double h = 0.0;                 ///< Fictive step.
  double time = 0.0;              ///< Physical time covered.
  long steps = 0;                 ///< Steps taken.
  long sweeps = 0;                ///< Evaluations of the field at all stages.
  double state_error = 0.0;       ///< Error of its final state, as far as known then; infinite on failure.
  Outcome outcome = Outcome::ok;  ///< How it ended.
};

/// The monitor, order and step for an orbit. From here on they are fixed, and the method is symplectic.
struct Choice {
  std::string name = "fixed";  ///< Name of the monitor, see SolveMonitor.
  int order = 0;               ///< Order of the method.
  double h = 0.0;              ///< Fictive step.
  /// Reference value of energy errors: half of \f$|p\cdot\dot q|\f$, averaged over a sketch of the beginning,
  /// and of a later part that is far faster; or over the run, where H depends on time and that is larger.
  double energy_scale = 1.0;
  double kinetic = 0.0;  ///< Mean kinetic energy at the beginning, a constant of the monitors.
  std::vector<double> accelerations = {};  ///< Weights \f$w_i\f$ of the monitor of that name, see solve().
  /// \f$w_0, e_0\f$ of the monitor of that name, \f$w_k, e_k\f$ of each pole, then w of each bend.
  std::vector<double> poles = {};
  /// The diagonal \f$(H_{pp})_{ii}\f$ where positions change even at zero momenta, as in a magnetic field or
  /// a rotating frame; otherwise empty.
  std::vector<double> drifts = {};
  double solved = 6.25e-19;  ///< Relative change of a sweep below which a step counts as solved.
  double time = 0.0;         ///< Physical time covered by the short trials.
  long sweeps = 0;           ///< Evaluations of the field at all stages, in all trials.
  long check = 0;            ///< Evaluations of the comparison run, with a longer step, until the two part.
  std::vector<SolveTrial> trials = {};  ///< All trials, in order.
};

/// The monitor g(q, p) of a choice, to build a method: `poincare(H, start, monitor_of(choice, H, H_0))`.
/// @param hamiltonian H of (q, p), for which the choice was made @param energy_at_start \f$H_0\f$
/// @throws std::invalid_argument for H(q, t, p), for a choice whose monitor you gave yourself, and where the
/// constants of the choice do not belong to this H.
[[nodiscard]] Formula monitor_of(const Choice& choice, const Formula& hamiltonian, double energy_at_start);

/// How a run ended, what was chosen for it, and how accurate its end is: the part of a Solution that does not
/// depend on the dimension.
struct SolutionReport {
  Run run;                 ///< How the run ended; its steps and sweeps.
  Choice choice;           ///< Monitor, order and step, and the trials that led to them.
  double tolerance = 0.0;  ///< The tolerance that was asked for.
  /// Error of the state at the end, and also along the orbit if output there was requested; see solve().
  /// Infinite where unknown.
  double state_error = 0.0;
  double energy_error = 0.0;     ///< Largest |H - H_0| during the run, divided by choice.energy_scale.
  double energy_rounding = 0.0;  ///< Rounding error of H; at least 0.01 energy_error if that is rounding.
  std::string note;              ///< Warnings in full sentences; often empty.

  /// True where the run reached its end time, or an event that ends it.
  [[nodiscard]] bool ok() const { return run.outcome == Outcome::ok; }
  /// True where ok() holds and the error of the state, as far as two runs with different steps can tell, is
  /// at most ten times the tolerance; and the energy error as well, unless rounding of H hides it.
  [[nodiscard]] bool kept() const {
    return ok() && state_error <= 10.0 * tolerance &&
           energy_error <= 10.0 * tolerance + 100.0 * energy_rounding;
  }
  /// A few lines of text: whether the tolerance was kept and if not why, the choice, and the trials.
  [[nodiscard]] std::string report() const;
};

namespace detail {

/// States of an orbit as plain numbers.
struct OrbitPoints {
  std::vector<double> t;  ///< Times.
  std::vector<double> z;  ///< (q, p) at each time, 2n numbers.
};

/// The orbit as a function of time, between the ends of a run. Several threads may evaluate it at once.
class OrbitCurve {
 public:
  virtual ~OrbitCurve() = default;
  /// Writes (q, p), 2n numbers, at time t into z. @throws std::invalid_argument for t outside the run.
  virtual void at(double t, double* z) const = 0;
  /// The start time, followed by the end time of every step.
  [[nodiscard]] virtual const std::vector<double>& times() const = 0;

 protected:
  OrbitCurve() = default;
  OrbitCurve(const OrbitCurve&) = default;
  OrbitCurve& operator=(const OrbitCurve&) = default;
};

/// An event to be located.
struct OrbitEvent {
  Formula g;         ///< Function of (q, p), or of (q, p, t).
  EventRules rules;  ///< Which zeros count.
};

struct Prepared;

/// The arguments of solve() as plain numbers. No Eigen vectors: their layout depends on the instruction set,
/// and the library may be compiled for another one than its caller.
struct OrbitQuestion {
  ExpressionGraph graph;               ///< Inputs (q, p), 2n of them; or (q, p, t) where H depends on time.
  int energy;                          ///< Node of H.
  std::vector<double> q = {}, p = {};  ///< Start, n numbers each.
  double t = 0.0, t_end = 0.0, tolerance = 0.0;  ///< Start, end, tolerance.
  SolveOptions options = {};            ///< Bounds and fixed settings; `events` below replaces its events.
  std::vector<double> times = {};       ///< Output times, from the start to the end.
  std::vector<OrbitEvent> events = {};  ///< Events to locate.
  std::shared_ptr<const Choice> made = {};        ///< A choice made earlier, if any,
  std::shared_ptr<const Prepared> prepared = {};  ///< and what was derived from H for it.
  bool timed = false;                             ///< Time is the last coordinate; set by the library only.
  std::shared_ptr<const class Switches> switches = {};  ///< Times at which H switches, if any; likewise.
  std::shared_ptr<const class Kinks> kinks = {};        ///< Where H has kinks; likewise.
  std::shared_ptr<const class Barriers> barriers = {};  ///< Where H is infinite, if it may be; likewise.
  std::vector<int> gradient = {};  ///< Nodes of dH/d(q, p), 2n, where H supplies them; else empty.
  int given = -1;                  ///< Node of the user's own monitor, or -1.
};

/// The result of a call of solve(), as plain numbers.
struct OrbitAnswer : SolutionReport {
  std::vector<double> q, p;                  ///< Final state.
  double t = 0.0;                            ///< Its time.
  OrbitPoints states;                        ///< States at the output times that the run reached.
  std::vector<int> events;                   ///< Index of the event, for each zero found,
  OrbitPoints event_states;                  ///< and the states there.
  std::shared_ptr<const OrbitCurve> curve;   ///< The orbit, if SolveOptions::dense was set.
  std::shared_ptr<const Prepared> prepared;  ///< Field of H and formulas of the choice.
};

/// solve() without types that depend on H or n.
OrbitAnswer answer(OrbitQuestion&& question);
/// resume() without types that depend on H or n; of the question, H, events, bounds and dimension are used.
OrbitAnswer answer_from(const std::string& file, OrbitQuestion&& question);
/// Makes the choice of solve() and stores it in the question of a Solver.
/// @return what is known of the sample orbit
/// @throws std::invalid_argument as solve(), and where nothing could be chosen.
SolutionReport choose_for(OrbitQuestion& question);

/// @throws std::invalid_argument unless there are times, finite, in one direction from the start on.
void require_times(double start, const std::vector<double>& times);
/// @throws std::invalid_argument unless H is of (q, p) or (q, p, t) with n degrees of freedom.
void require_arguments(int inputs, int n);
/// Records the events and the monitor that the options of a question hold.
/// @throws std::invalid_argument for an event not made by when(), or a function of other arguments.
void add_functions(OrbitQuestion& question);
/// @throws std::logic_error always: the solution that was called has no curve.
[[noreturn]] void no_curve();

/// The State with these q and p, `count` numbers each.
template <int n>
State<n> state_of(double t, const double* q, const double* p, int count) {
  State<n> state;
  if constexpr (n == dynamic) state.q.resize(count), state.p.resize(count);
  for (int i = 0; i < count; ++i) {
    state.q[i] = q[i];
    state.p[i] = p[i];
  }
  state.t = t;
  return state;
}

}  // namespace detail

/// A zero of an event function, located on the orbit.
template <int n>
struct FoundEvent {
  int index;       ///< Index of the event in SolveOptions::events.
  State<n> state;  ///< State on g = 0 or just beyond it, to rounding; its t is the time of the event.
};

/// The state at the end of an orbit, the output requested along it, and how accurate they are.
template <int n>
struct Solution : SolutionReport {
  State<n> state;  ///< State at the end, or the last valid one; NaN where no run was begun.
  std::vector<State<n>> states = {};  ///< States at the output times; their t equals those times exactly.
  std::vector<FoundEvent<n>> events = {};  ///< Zeros of the events, in the order in which the run met them.
  std::shared_ptr<const detail::OrbitCurve> curve = {};  ///< The orbit, evaluated by operator().

  /// The state at any time of the run, if SolveOptions::dense was set. It is found by one symplectic step
  /// from the end of the preceding step and is as accurate as that. Several threads may call it at once.
  /// @throws std::invalid_argument for a time outside the run.
  /// @throws std::logic_error without SolveOptions::dense, or where the call ended before the run that
  /// delivers.
  [[nodiscard]] State<n> operator()(double t) const {
    if (!curve) detail::no_curve();
    const int count = static_cast<int>(state.q.size());
    std::vector<double> z(2 * static_cast<std::size_t>(count));
    curve->at(t, z.data());
    return detail::state_of<n>(t, z.data(), z.data() + count, count);
  }
  /// The states at several times.
  [[nodiscard]] std::vector<State<n>> operator()(const std::vector<double>& times) const {
    std::vector<State<n>> found;
    found.reserve(times.size());
    for (const double t : times)
      found.push_back((*this)(t));
    return found;
  }
};

namespace detail {

/// The question, in plain numbers, about an H given as a node of a graph.
template <int n>
OrbitQuestion question_of(ExpressionGraph&& graph, int energy, const State<n>& start, double t_end,
                          double tolerance, const SolveOptions& options) {
  const auto count = start.q.size();
  OrbitQuestion question{std::move(graph),
                         energy,
                         {start.q.data(), start.q.data() + count},
                         {start.p.data(), start.p.data() + count},
                         start.t,
                         t_end,
                         tolerance,
                         options};
  add_functions(question);
  return question;
}

/// The same for an H that is already recorded.
template <int n>
OrbitQuestion question_of(const Formula& hamiltonian, const State<n>& start, double t_end, double tolerance,
                          const SolveOptions& options) {
  require_dimension(start);
  require_arguments(hamiltonian.inputs(), static_cast<int>(start.q.size()));
  const Formula energy = hamiltonian.with_constants();
  return question_of(ExpressionGraph(energy.graph()), energy.node(), start, t_end, tolerance, options);
}

/// Records H(q, p), with the gradient that it supplies if any, or H(q, t, p).
template <int n, class H>
OrbitQuestion question_of(const H& hamiltonian, const State<n>& start, double t_end, double tolerance,
                          const SolveOptions& options) {
  using Vec = RecordedVector<n>;
  require_dimension(start);
  const int count = static_cast<int>(start.q.size());
  if constexpr (takes_time<H, n>()) {
    return question_of(Formula::of_phase_and_time<n>(hamiltonian, count), start, t_end, tolerance, options);
  } else if constexpr (requires(const Vec& x) { hamiltonian.d_dq(x, x), hamiltonian.d_dp(x, x); }) {
    ExpressionGraph graph(2 * count);
    const Vec q = recorded_inputs<n>(graph, 0, count), p = recorded_inputs<n>(graph, count, count);
    const int energy = recorded_call(hamiltonian, q, p).node_in(graph);
    std::vector<int> gradient = supplied_gradient(hamiltonian, q, p, graph);
    OrbitQuestion question = question_of(std::move(graph), energy, start, t_end, tolerance, options);
    question.gradient = std::move(gradient);
    return question;
  } else {
    return question_of(Formula::of_phase<n>(hamiltonian, count), start, t_end, tolerance, options);
  }
}

/// Converts the answer into states.
template <int n>
Solution<n> solution_of(OrbitAnswer&& found, int count) {
  Solution<n> solution{std::move(static_cast<SolutionReport&>(found)),
                       state_of<n>(found.t, found.q.data(), found.p.data(), count)};
  const auto each = [&](const OrbitPoints& points, const auto& use) {
    for (std::size_t i = 0; i < points.t.size(); ++i) {
      const double* z = points.z.data() + 2 * i * static_cast<std::size_t>(count);
      use(i, state_of<n>(points.t[i], z, z + count, count));
    }
  };
  each(found.states, [&](std::size_t, State<n>&& z) { solution.states.push_back(std::move(z)); });
  each(found.event_states, [&](std::size_t i, State<n>&& z) {
    solution.events.push_back({found.events[i], std::move(z)});
  });
  solution.curve = std::move(found.curve);
  return solution;
}

}  // namespace detail

/// Integrates Hamilton's equations of H from `start` to the physical time `t_end`.
///
/// The tolerance applies to the state at the end: each coordinate and momentum is right to about `tolerance`
/// times the range that it covers, or 1e-8 times that of another entry of similar mass if this is larger. A
/// momentum that hardly changes, such as that of a fast rotor, counts as covering 1e-8 of its size, and an
/// entry that rests by symmetry and drifts only by rounding 1e-8 of that other range; or, if that is more,
/// both thirty units in the last place divided by the tolerance. SolutionReport::state_error is the error
/// achieved: the difference from a second run with a longer step, reduced according to the order. In runs of
/// up to 300 steps a third run confirms it, unless it is far below the tolerance. Runs of more than about
/// sixty revolutions take their step from the errors on the first few; these grow linearly in time where
/// motion is regular. Without SolveOptions::check that is all there is of the second run: the cost is halved,
/// but chaos that begins later is missed. Where the motion does not allow the tolerance (chaos, rounding, a
/// wall thinner than a step), kept() is false and report() says why.
///
/// The method is Gauss collocation with constant steps in the fictive time of one of these monitors. It is
/// symplectic except where a step is cut: the last one, at t_end, and those at kinks and switches of H:
///
/// | name | g |
/// | --- | --- |
/// | fixed | 1 |
/// | energy, energy^1.5 | \f$(\bar T + \frac12(H + H_0) - V(q))^{-\alpha}\f$, \f$\alpha = 1\f$ or 3/2 |
/// | poles | \f$\bigl(\rho^2 + (\rho/\sqrt\phi)\, \psi\, (H - H_0)/2E\bigr)^{-1}\f$ |
/// | acceleration | \f$(1 + \sum_i (w_i\, \partial H/\partial q_i)^2)^{-3/8}\f$ |
/// | splitting | 1, by an explicit method of order 6 where \f$H = T(p) + V(q)\f$ with T quadratic |
///
/// Here \f$V(q) = H(q, p^*)\f$ is H at the momenta of zero velocity: \f$p^* = 0\f$, or, in a magnetic field
/// or a rotating frame, \f$p^*_i = -\partial H/\partial p_i(q, 0)/(H_{pp})_{ii}\f$. \f$\bar T\f$ is the mean
/// kinetic energy H - V at the beginning. The distances \f$s_k\f$ to the poles of H are functions of q by
/// which H divides or whose logarithm it contains; near a pole H is of the order \f$s_k^{-a_k}\f$. There
/// \f$\phi_k = w_k s_k^{-1-a_k/2}\f$ is the frequency of the motion, \f$\phi = \sum_k \phi_k\f$, \f$\psi =
/// \sum_k (1 + a_k/2)\, \phi_k\f$, \f$\rho = \sqrt{w_0} + \sqrt\phi\f$ with a constant \f$w_0\f$ for free
/// motion, and \f$E = e_0 + \sum_k e_k s_k^{-a_k}\f$ an energy. Where H bends within a length \f$s_k\f$, as
/// \f$\sqrt{\varepsilon^2 + q^2}\f$ does, \f$w_k/s_k\f$ is added to \f$\phi\f$. Weights \f$w_i =
/// (H_{pp})_{ii}/\bar a L_i\f$ come from ranges \f$L_i\f$ and a mean acceleration \f$\bar a\f$: for forces by
/// the inverse square that is the time two bodies take to pass each other. The explicit method is the
/// splitting with 14 stages of Blanes and Moan (2002), for loose tolerances or many degrees of freedom.
///
/// Monitor, order and step are those that take the least work in short trials. The same input gives the same
/// choice; units, and constants added to H, do not matter. H is called once, to record its operations.
/// @throws std::invalid_argument for H or its slope not finite at the start, input out of range, or a monitor
/// without meaning for H; std::runtime_error for a checkpoint that cannot be written.
template <class H, int n>
[[nodiscard]] Solution<n> solve(const H& hamiltonian, const State<n>& start, double t_end, double tolerance,
                                const SolveOptions& options = {}) {
  return detail::solution_of<n>(
      detail::answer(detail::question_of(hamiltonian, start, t_end, tolerance, options)),
      static_cast<int>(start.q.size()));
}

/// The same with the states at `times`, the last of which is the end. They must run in the direction of the
/// run; the start and repeated times are allowed. Each state costs one symplectic step from the end of the
/// preceding step. With times, events or a dense solution the tolerance also applies along the orbit, where
/// motion may be faster than at the end, regardless of which times are given.
/// @throws std::invalid_argument as above, and for times that are missing, not finite or out of order.
template <class H, int n>
[[nodiscard]] Solution<n> solve(const H& hamiltonian, const State<n>& start, const std::vector<double>& times,
                                double tolerance, const SolveOptions& options = {}) {
  detail::OrbitQuestion question =
      detail::question_of(hamiltonian, start, times.empty() ? start.t : times.back(), tolerance, options);
  detail::require_times(question.t, times);
  question.times = times;
  return detail::solution_of<n>(detail::answer(std::move(question)), static_cast<int>(start.q.size()));
}

/// Resumes a run from the file of SolveOptions::checkpoint; its states have the same bits as without the
/// interruption by a bound, the callback or the end of the program. The file holds all settings, including
/// order, monitor and h, except for H, the events and your own monitor, which must be the same as before.
/// @tparam n as that of the original start @param n_of_start the degrees of freedom where n is avi::dynamic
/// @param options seconds and progress for the rest, bounds on sweeps and steps of the whole run, events, and
/// your own monitor; other options are ignored
/// @throws std::invalid_argument for a file that cannot be read, is damaged or is of another H, and for
/// n_of_start below 1 or different from n.
template <int n, class H>
[[nodiscard]] Solution<n> resume(const H& hamiltonian, const std::string& file,
                                 const SolveOptions& options = {}, int n_of_start = n) {
  if (n_of_start < 1 || (n != dynamic && n_of_start != n))
    throw std::invalid_argument("The degrees of freedom of a run to be resumed are " +
                                std::to_string(n_of_start) +
                                (n == dynamic ? "; they must be at least 1: the last argument of resume()."
                                              : "; they must be " + std::to_string(n) + "."));
  const std::vector<double> nothing(static_cast<std::size_t>(n_of_start));
  const State<n> start = detail::state_of<n>(0.0, nothing.data(), nothing.data(), n_of_start);
  return detail::solution_of<n>(
      detail::answer_from(file, detail::question_of(hamiltonian, start, 0.0, 1e-6, options)), n_of_start);
}

}  // namespace avi

#include "avi/solve_refused.hpp"
