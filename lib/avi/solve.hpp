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
/// An orbit from H, a start, an end and a tolerance; everything else is chosen.

namespace avi {

/// The mass of a test particle. It cannot be 0, by which H would divide; this one is a power of two, so that
/// p / m is the velocity to the last bit, and so small that what the body does to others is below their
/// rounding, in any units.
inline constexpr double massless = 0x1p-200;

namespace detail {
/// f takes a time: f(q, t, p).
template <class F, int n = dynamic>
constexpr bool takes_time() {
  using Vec = RecordedVector<n>;
  return std::is_invocable_v<const F&, const Vec&, const Recorded&, const Vec&>;
}
/// A function that records g(q), g(q, p) or g(q, t, p) for n degrees of freedom.
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

/// Which zeros of an event function count, and whether one of them ends the run.
struct EventRules {
  int direction = 0;  ///< 1 where it rises as the run goes, -1 where it falls, 0 for both.
  long count = 0;     ///< How many to look for; 0 for all, or for the first where `stop` is set.
  bool stop = false;  ///< The run ends on the last of them, as ok.
};

/// A function of the state whose zeros are looked for along an orbit; made by when().
struct SolveEvent {
  SolveEvent() = default;  ///< An event without a function, which solve() refuses.
  /// Takes what records g, and the rules.
  SolveEvent(std::function<Formula(int)> its_g, EventRules its_rules)
      : g(std::move(its_g)), rules(its_rules) {}
  /// Refuses a function alone: when() makes an event of it.
  template <class G>
  requires(!std::is_same_v<G, SolveEvent> && !std::is_same_v<G, std::vector<SolveEvent>>)
      SolveEvent(const G&) {
    static_assert(std::is_void_v<G>, "An event is made by when(): {.events = {avi::when(g)}}.");
  }

  std::function<Formula(int)> g;  ///< Records g for n degrees of freedom: of (q, p), or (q, p, t).
  EventRules rules;               ///< Which zeros count.
};

/// The zeros of g(q), g(q, p) or g(q, t, p) along an orbit, for SolveOptions::events. g is called once, with
/// vectors of a scalar that records what is done to it, as H is. It is looked at in nine points of every
/// step, and in more, a thousand at most, where it is no smooth curve through them; a run in which it changes
/// its sign more often than they can show ends as not_converged. Between two points near zero its slopes say
/// whether it turns there, so that zeros close to one another are found, and where it nearly touches zero
/// steps of the method say on which side it stays. A zero at the start does not count. Where g changes its
/// sign by a jump or a pole the run ends as not_converged, where it is NaN as non_finite, as in Event.
template <class G>
[[nodiscard]] SolveEvent when(G g, EventRules rules = {}) {
  return {detail::recorder(std::move(g)), rules};
}

/// The monitor of a run, \f$dt = g\,d\tau\f$: one of the menu of solve() by its name, or a function g(q),
/// g(q, p) or g(q, t, p) of your own, positive, smooth and called once, as H is; its name is "given".
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

  std::string name = {};               ///< Empty to have it chosen.
  std::function<Formula(int)> g = {};  ///< Records it for n degrees of freedom.
};

/// The phase of a call of solve().
enum class SolvePhase {
  choosing,  ///< Monitor, order and step are chosen; where runs are compared, this includes them.
  running,   ///< The run whose states are delivered.
  checking   ///< A run with a longer step, which tells how wrong the other one is.
};

/// How far a call of solve() has come, for SolveOptions::progress.
struct SolveProgress {
  SolvePhase phase = SolvePhase::choosing;  ///< Phase of the call.
  double t = 0.0;                           ///< Physical time of the run under way.
  double fraction = 0.0;                    ///< Share of its way to the end, in [0, 1].
  long steps = 0;                           ///< Steps of that run.
  long sweeps = 0;                          ///< Sweeps of the whole call.
  double seconds = 0.0;                     ///< Since the call began.
};

/// Further wishes for a call of solve(), bounds on its cost, and settings that are fixed rather than chosen.
/// A call that meets a bound ends with an outcome that says so and keeps what it had reached.
struct SolveOptions {
  double seconds = std::numeric_limits<double>::infinity();  ///< Wall-clock time; at least 0.
  bool check = true;            ///< Two runs are compared, all the way or until they part; see solve().
  long sweeps = 2'000'000'000;  ///< Evaluations of the field at all stages, trials included; at least 1.
  long steps = std::numeric_limits<long>::max();  ///< Steps of a run; at least 1.
  int order = 0;                                  ///< Order of the method: 2, 4, ... 16; 0 to have it chosen.
  SolveMonitor monitor = {};            ///< Name in the menu of solve(), or a function; see SolveMonitor.
  double h = 0.0;                       ///< Fictive step with that monitor, positive; 0 to have it chosen.
  bool dense = false;                   ///< The solution can be called at any time of the run.
  std::vector<SolveEvent> events = {};  ///< Events to look for on the way; see when().
  /// Called some twenty times a second from the thread of the call; false ends the call as stopped. What it
  /// throws leaves the call, which then has changed nothing but a checkpoint.
  std::function<bool(const SolveProgress&)> progress = {};
  /// File in which the run is kept for resume() until it has come to its end; empty for none. So that a run
  /// that goes on has the same bits, the method begins anew every 4096 steps, each time with a rounding
  /// error. The run that is kept is the last one of the call, which delivers the states. Before it one run,
  /// or two with `check`, go to the end: until then there is no file, or that of an earlier call.
  /// A bound or a cancel that comes before leaves what was chosen so far.
  std::string checkpoint = {};
  double checkpoint_seconds = 60.0;  ///< Seconds after which the file is written anew; at least 0.
};

/// One run that was tried, whether it failed or not.
struct SolveTrial {
  std::string monitor;       ///< Name in the menu, see solve().
  int order = 0;             ///< Order of the method.
  double h = 0.0;            ///< Fictive step.
  double time = 0.0;         ///< Physical time that it covered.
  long steps = 0;            ///< Steps taken.
  long sweeps = 0;           ///< Evaluations of all stages.
  double state_error = 0.0;  ///< Error of the state at its end, as far as known then; infinite on failure.
  Outcome outcome = Outcome::ok;  ///< How it ended.
};

/// The choice for an orbit. From here on all of it is fixed, and the method is a symplectic map.
struct Choice {
  std::string name = "fixed";  ///< Name of the monitor, see SolveMonitor.
  int order = 0;               ///< Order of the method.
  double h = 0.0;              ///< Fictive step.
  /// What energy errors are relative to: the mean of half of \f$|p\cdot\dot q|\f$ over the beginning, or that
  /// over the run, where H depends on time and it is more.
  double energy_scale = 1.0;
  double kinetic = 0.0;  ///< Mean kinetic energy of the beginning, a constant of the monitors.
  std::vector<double> accelerations = {};  ///< Weights \f$w_i\f$ of the monitor of that name, see solve().
  std::vector<double> poles =
      {};  ///< Weights \f$w_0, w_1 \ldots\f$ of the monitor of that name, see solve().
  /// \f$(H_{pp})_{ii}\f$ where something moves that has no momenta, as in a magnetic field or a frame that
  /// turns; else empty.
  std::vector<double> drifts = {};
  double solved = 6.25e-19;  ///< Relative change of a sweep below which a step counts as solved.
  double time = 0.0;         ///< Physical time of the short trials.
  long sweeps = 0;           ///< Evaluations of all stages in all trials.
  long check = 0;  ///< Evaluations of the run with a longer step, which goes along until the two are apart.
  std::vector<SolveTrial> trials = {};  ///< All trials, in their order.
};

/// The monitor g(q, p) of a choice, for a method by hand: `poincare(H, start, monitor_of(choice, H, H_0))`.
/// @param hamiltonian H of (q, p), for which the choice was made @param energy_at_start \f$H_0\f$
/// @throws std::invalid_argument for H(q, t, p), for a monitor of your own, which you have already, and
/// where the constants of the choice are not those of this H.
[[nodiscard]] Formula monitor_of(const Choice& choice, const Formula& hamiltonian, double energy_at_start);

/// How a run ended, what was chosen for it and how good its end is: the part of a Solution that is the same
/// in every dimension.
struct SolutionReport {
  Run run;                 ///< How the run ended; its steps and sweeps.
  Choice choice;           ///< Monitor, order and step, and the trials that led to them.
  double tolerance = 0.0;  ///< The tolerance that was asked for.
  /// Error of the state at the end, and on the way where that is asked for; see solve(). Infinite where
  /// unknown.
  double state_error = 0.0;
  double energy_error = 0.0;     ///< Largest |H - H_0| of the run, over choice.energy_scale.
  double energy_rounding = 0.0;  ///< Rounding error of H; 0.01 energy_error where that is rounding.
  std::string note;              ///< Warnings for the reader, in sentences; often empty.

  /// True where the run reached what was asked for: its end, or an event that ends it.
  [[nodiscard]] bool ok() const { return run.outcome == Outcome::ok; }
  /// True where ok() is, and the error of the state is within ten times the tolerance, as far as two runs
  /// with different steps can tell; that of the energy too, unless rounding of H hides it.
  [[nodiscard]] bool kept() const {
    return ok() && state_error <= 10.0 * tolerance &&
           energy_error <= 10.0 * tolerance + 100.0 * energy_rounding;
  }
  /// In a few lines: whether the tolerance was kept and if not why, the choice, and the trials.
  [[nodiscard]] std::string report() const;
};

namespace detail {

/// States of an orbit as plain numbers.
struct OrbitPoints {
  std::vector<double> t;  ///< Times.
  std::vector<double> z;  ///< (q, p) for each of them, 2n numbers.
};

/// The orbit between the ends of a run. It may be asked by several threads at a time.
class OrbitCurve {
 public:
  virtual ~OrbitCurve() = default;
  /// (q, p), 2n numbers, at the time t. @throws std::invalid_argument where the run has not been.
  virtual void at(double t, double* z) const = 0;
  /// When its steps ended, and before them when it began.
  [[nodiscard]] virtual const std::vector<double>& times() const = 0;

 protected:
  OrbitCurve() = default;
  OrbitCurve(const OrbitCurve&) = default;
  OrbitCurve& operator=(const OrbitCurve&) = default;
};

/// An event that is looked for.
struct OrbitEvent {
  Formula g;         ///< Function of (q, p), or of (q, p, t).
  EventRules rules;  ///< Which zeros count.
};

struct Prepared;

/// An orbit that is asked for. Holds no vector of another library: the processor may be another one there.
struct OrbitQuestion {
  ExpressionGraph graph;  ///< Inputs are (q, p), 2n of them; or (q, p, t), where H depends on time.
  int energy;             ///< Node of H.
  std::vector<double> q = {}, p = {};             ///< Start, n numbers each.
  double t = 0.0, t_end = 0.0, tolerance = 0.0;   ///< Start, end, tolerance.
  SolveOptions options = {};                      ///< Bounds, and what is fixed; its events are those below.
  std::vector<double> times = {};                 ///< Where states are wanted, from the start to the end.
  std::vector<OrbitEvent> events = {};            ///< Events to look for on the way.
  std::shared_ptr<const Choice> made = {};        ///< A choice that is made already, unless it is empty,
  std::shared_ptr<const Prepared> prepared = {};  ///< and what is made of H for it.
  bool timed = false;  ///< Time has been made the last coordinate: not for callers.
  std::shared_ptr<const class Switches> switches = {};  ///< Times at which H switches, if any; likewise.
  std::shared_ptr<const class Kinks> kinks = {};        ///< Where it has kinks; likewise.
  std::vector<int> gradient = {};  ///< Nodes of dH/d(q, p), 2n, where H supplies them; else empty.
  int given = -1;                  ///< Node of a monitor of one's own, or none.
};

/// The answer.
struct OrbitAnswer : SolutionReport {
  std::vector<double> q, p;                  ///< State.
  double t = 0.0;                            ///< Its time.
  OrbitPoints states;                        ///< At the times asked for, as far as the run came.
  std::vector<int> events;                   ///< Number of the event, for each that was found,
  OrbitPoints event_states;                  ///< and where.
  std::shared_ptr<const OrbitCurve> curve;   ///< With SolveOptions::dense.
  std::shared_ptr<const Prepared> prepared;  ///< Field of H and formulas of the choice.
};

/// solve() without types that depend on H or n.
OrbitAnswer answer(OrbitQuestion&& question);
/// resume() without types that depend on H or n; of the question H, events, bounds and the dimension count.
OrbitAnswer answer_from(const std::string& file, OrbitQuestion&& question);
/// Puts the choice of solve() into the question of a Solver.
/// @return what is known of the orbit that it is made for
/// @throws std::invalid_argument where nothing could be chosen, too.
SolutionReport choose_for(OrbitQuestion& question);

/// @throws std::invalid_argument unless there are times, finite, in one direction from the start on.
void require_times(double start, const std::vector<double>& times);
/// @throws std::invalid_argument unless H is of (q, p) or (q, p, t) with n degrees of freedom.
void require_arguments(int inputs, int n);
/// Records the events and the monitor among the options of a question.
/// @throws std::invalid_argument for an event that was not made by when(), and for one of other arguments.
void add_functions(OrbitQuestion& question);
/// @throws std::logic_error where a solution is called that has no curve.
[[noreturn]] void no_curve();

/// q and p of n numbers each as a state.
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

/// An event that was found.
template <int n>
struct FoundEvent {
  int index;       ///< Place of the event in SolveOptions::events.
  State<n> state;  ///< On g = 0 or beyond it, to rounding, as accurate as the run; its t is the time.
};

/// The end of an orbit, what was asked for on the way, and how good they are.
template <int n>
struct Solution : SolutionReport {
  State<n> state;                          ///< At the end, or the last good one; NaN where no run was begun.
  std::vector<State<n>> states = {};       ///< At the times asked for, whose t are those times to the bit.
  std::vector<FoundEvent<n>> events = {};  ///< In the order in which the run met them.
  std::shared_ptr<const detail::OrbitCurve> curve = {};  ///< The orbit that operator() evaluates.

  /// The state at any time of the run, where SolveOptions::dense was set: by a symplectic step from the last
  /// step before it, as accurate as the ends of steps. Several threads may call it at a time.
  /// @throws std::invalid_argument for a time where the run has not been.
  /// @throws std::logic_error where the run was made without SolveOptions::dense, or the call ended before
  /// it.
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

/// Puts a question into plain numbers.
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

/// Takes H that is recorded already.
template <int n>
OrbitQuestion question_of(const Formula& hamiltonian, const State<n>& start, double t_end, double tolerance,
                          const SolveOptions& options) {
  require_dimension(start);
  require_arguments(hamiltonian.inputs(), static_cast<int>(start.q.size()));
  const Formula energy = hamiltonian.with_constants();
  return question_of(ExpressionGraph(energy.graph()), energy.node(), start, t_end, tolerance, options);
}

/// Records H(q, p), with its gradient where it has one of its own, or H(q, t, p).
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

/// Puts the answer into states.
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

/// Integrates the orbit of H from `start` to the physical time `t_end`.
///
/// The tolerance is for the state at the end: every coordinate and every momentum is right to about
/// `tolerance` times the range through which it moves, or 1e-8 times that of another one of about its mass
/// where that is more. What hardly changes, as the momentum of a fast rotor, or what rests by symmetry and
/// wanders by rounding, is taken for something that moves by 1e-8 of its size, or of that other range, or by
/// thirty of its last digits over the tolerance. SolutionReport::state_error says what came of it: the
/// difference to a second run with a longer step, reduced by the order of the method; in runs of up to 300
/// steps, where that is not far below the tolerance, a third one confirms it. Runs of more than some sixty
/// turns find their step from the errors of the first sixteenth, which grow linearly in time where motion is
/// regular; without SolveOptions::check that is all there is of the second run, at a half of the price, and
/// chaos that begins later is not seen. Where the motion does not allow the tolerance (chaos, rounding, a
/// wall thinner than a step), kept() is false and report() says why.
///
/// The method is Gauss collocation with constant steps in the fictive time of one of these monitors,
/// symplectic but for the last, shorter step that ends at t_end:
///
/// | name | g |
/// | --- | --- |
/// | fixed | 1 |
/// | energy, energy^1.5 | \f$(\bar T + \frac12(H + H_0) - V(q))^{-\alpha}\f$, \f$\alpha = 1\f$ or 3/2 |
/// | poles | \f$\bigl(\rho^2 + (\rho/\sqrt\phi)\, \psi\, (H - H_0)/2E\bigr)^{-1}\f$ |
/// | acceleration | \f$(1 + \sum_i (w_i\, \partial H/\partial q_i)^2)^{-3/8}\f$ |
/// | splitting | 1, by an explicit method of order 6 where \f$H = T(p) + V(q)\f$ with T quadratic |
///
/// with \f$V(q) = H(q, p^*)\f$ at the momenta where nothing moves, \f$p^* = 0\f$ or, in a magnetic field or a
/// frame that turns, \f$p^*_i = -\partial H/\partial p_i(q, 0)/(H_{pp})_{ii}\f$; the mean kinetic energy
/// \f$\bar T\f$, of H - V, of the beginning; the distances \f$s_k\f$ to the poles of H, functions of q that
/// it divides by or has the logarithm of, near which it is of the order \f$s_k^{-a_k}\f$: there
/// \f$\phi_k = w_k s_k^{-1-a_k/2}\f$ is the frequency of what moves, \f$\phi = \sum_k \phi_k\f$,
/// \f$\psi = \sum_k (1 + a_k/2)\, \phi_k\f$, \f$\rho = \sqrt{w_0} + \sqrt\phi\f$ with a constant for free
/// motion, and \f$E = e_0 + \sum_k e_k s_k^{-a_k}\f$ an energy; and \f$w_i = (H_{pp})_{ii}/\bar a L_i\f$ of
/// its ranges \f$L_i\f$ and a mean of its accelerations: where forces fall with the square of a distance,
/// this is the time in which two bodies pass each other, whatever their masses. The explicit method is the
/// Runge-Kutta-Nystrom splitting with 14 stages of Blanes and Moan (2002); it is taken where tolerances are
/// loose, or degrees of freedom many.
///
/// Monitor, order and step are those that take the least work in short trials. The same input gives the same
/// choice; units and masses do not matter. H is called once, with a scalar that records what is done to it.
/// @throws std::invalid_argument where H is not finite at the start, or for a time, tolerance or bound out of
/// range.
template <class H, int n>
[[nodiscard]] Solution<n> solve(const H& hamiltonian, const State<n>& start, double t_end, double tolerance,
                                const SolveOptions& options = {}) {
  return detail::solution_of<n>(
      detail::answer(detail::question_of(hamiltonian, start, t_end, tolerance, options)),
      static_cast<int>(start.q.size()));
}

/// The same with the states at `times`, the last of which is the end: any number of them, in the direction of
/// the run, the start and equal ones included. Each is found by a symplectic step from the last step before
/// it, which is what it costs. Where times, events or a curve are asked for, the tolerance is for the states
/// on the way, too, where the motion may be faster than at the end; at which times does not matter.
/// @throws std::invalid_argument as the other one, and for times that are none, not finite or out of order.
template <class H, int n>
[[nodiscard]] Solution<n> solve(const H& hamiltonian, const State<n>& start, const std::vector<double>& times,
                                double tolerance, const SolveOptions& options = {}) {
  detail::OrbitQuestion question =
      detail::question_of(hamiltonian, start, times.empty() ? start.t : times.back(), tolerance, options);
  detail::require_times(question.t, times);
  question.times = times;
  return detail::solution_of<n>(detail::answer(std::move(question)), static_cast<int>(start.q.size()));
}

/// Goes on with a run that SolveOptions::checkpoint has kept in a file, with the same bits as if it had not
/// been interrupted: by a bound, by the callback, by the end of the program. What was asked for is in the
/// file, order, monitor and h included, but for H, the events, and a monitor of your own, which have to be
/// the same.
/// @tparam n of the start that the run began with @param n_of_start its value, where n is avi::dynamic
/// @param options seconds and progress of what is left, bounds on sweeps and steps of the whole run, events,
/// a monitor of your own; nothing else counts
/// @throws std::invalid_argument for a file that cannot be read, is damaged, or is of another H, and for
/// n_of_start below 1, or other than n.
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
