#include "traced.hpp"

#include "avi/optim/minimise.hpp"
#include "avi/solve.hpp"
#include "avi/version.hpp"

#include <pybind11/stl.h>

#include <chrono>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

/// @file
/// The module avi._avi: formulas of Python's functions, and the library's front doors. What makes them
/// pleasant is in Python (lib/python/avi).

namespace avi::python {
namespace {

/// Doubles in C order.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

VectorX vector_of(const Numbers& x) { return Eigen::Map<const VectorX>(x.data(), x.size()); }
Numbers array_of(const VectorX& x) { return Numbers(x.size(), x.data()); }

/// Notices Ctrl-C from time to time where Python's lock is not held.
class Signals {
 public:
  bool pressed = false;  ///< Ctrl-C was.

  /// Whether it was. Looks at the clock only, unless 50 ms have passed. @throws what another signal's handler
  /// raises.
  bool interrupted() {
    const auto now = std::chrono::steady_clock::now();
    if (pressed || now < next_) return pressed;
    next_ = now + std::chrono::milliseconds(50);
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) note(py::error_already_set());
    return pressed;
  }
  /// Keeps a KeyboardInterrupt, throws anything else again.
  void note(const py::error_already_set& error) {
    if (!error.matches(PyExc_KeyboardInterrupt)) throw error;
    pressed = true;
  }

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

/// Calls f once with arrays of these shapes, and the parameters where there are any; what it returns is the
/// formula.
Formula trace(const py::object& f, const std::vector<Shape>& shapes, std::vector<double> parameters,
              const char* name) {
  double numbers = 0.0;  // of any shape, which an integer may not hold
  for (const Shape& shape : shapes)
    numbers += std::accumulate(shape.begin(), shape.end(), 1.0, std::multiplies<>());
  require(numbers > 0.0, "Number of arguments to record", numbers, "at least 1");
  require(numbers < 1e9, "Number of arguments to record", numbers, "less than 1e9");
  const int count = static_cast<int>(numbers);
  int first = 0;
  const auto graph = std::make_shared<ExpressionGraph>(count + static_cast<int>(parameters.size()));
  py::list arguments;
  for (const Shape& shape : shapes)
    arguments.append(inputs(graph, std::exchange(first, first + static_cast<int>(size_of(shape))), shape));
  if (!parameters.empty())
    arguments.append(inputs(graph, count, {static_cast<py::ssize_t>(parameters.size())}));
  const int node = returned_node(f(*arguments), *graph, name), late = graph->late_inputs();
  if (late == 0) return {*graph, node, std::move(parameters)};
  // Products of x with matrices come between x and the parameters.
  const int inputs = graph->inputs();
  std::vector<int> places;
  for (int i = 0; i < inputs + late; ++i)
    places.push_back(i < count ? i : i < inputs ? i + late : i - (inputs - count));
  ExpressionGraph whole(inputs + late);
  const int moved = whole.substitute(*graph, node, places);
  return {std::move(whole), moved, std::move(parameters)};
}

/// Numbers that belong to Python from here on, row by row, without a copy.
py::array given(std::vector<double>&& numbers, py::ssize_t columns) {
  auto kept = std::make_unique<std::vector<double>>(std::move(numbers));
  const py::capsule owner(kept.get(), [](void* p) { delete static_cast<std::vector<double>*>(p); });
  const auto& all = *kept.release();
  return py::array_t<double>({static_cast<py::ssize_t>(all.size()) / columns, columns}, all.data(), owner);
}

/// Calls a callback, if there is one. False where it returns False or raises StopIteration, or after Ctrl-C.
template <class Argument>
bool tell(const py::object& callback, const Argument& argument, Signals& signals) {
  if (!callback.is_none()) {
    const py::gil_scoped_acquire locked;
    try {
      // A False of Python or of NumPy ends the run; None and numbers do not.
      py::detail::make_caster<bool> answer;
      if (answer.load(callback(argument()), false) && !static_cast<bool>(answer)) return false;
    } catch (const py::error_already_set& error) {
      if (error.matches(PyExc_StopIteration)) return false;
      signals.note(error);
    }
  }
  return !signals.interrupted();
}

using Events = std::vector<std::tuple<Formula, int, long, bool>>;

/// Asks for an orbit of H and gives Python the answer. Ctrl-C ends the run as `progress` does.
/// @param ask called with the options, without Python's lock
template <class Ask>
py::tuple orbit(const Formula& hamiltonian, SolveOptions options, const Events& events,
                const py::object& progress, const Ask& ask) {
  Signals signals;
  options.progress = [&](const SolveProgress& now) {
    return tell(
        progress, [&] { return py::make_tuple(now.fraction, now.t, now.steps, now.seconds); }, signals);
  };
  for (const auto& [g, direction, count, stop] : events)
    options.events.push_back(when(g, {.direction = direction, .count = count, .stop = stop}));
  detail::OrbitAnswer found = [&] {
    const py::gil_scoped_release unlocked;
    return ask(options);
  }();
  if (signals.pressed)
    found.run.message =
        "Stopped by Ctrl-C." + (found.run.outcome == Outcome::stopped ? "" : " " + found.run.message);
  const py::ssize_t n = hamiltonian.inputs() / 2 * 2;
  return py::make_tuple(SolutionReport(found), given(std::move(found.states.t), 1),
                        given(std::move(found.states.z), n), found.t, found.q, found.p, found.events,
                        given(std::move(found.event_states.t), 1), given(std::move(found.event_states.z), n),
                        found.curve);
}

/// The orbit from the first to the last of these times, with its states at all of them where `deliver`.
/// @param made the report of an orbit whose choice is taken over, or null
/// @param choose only the choice is made, with what is known of the orbit
py::tuple solve(const Formula& hamiltonian, const Numbers& q, const Numbers& p, const Numbers& times,
                bool deliver, double tolerance, const SolveOptions& options, const Events& events,
                const py::object& progress, const SolutionReport* made, bool choose) {
  const State<dynamic> start{.q = vector_of(q), .p = vector_of(p), .t = times.at(0)};
  return orbit(hamiltonian, options, events, progress, [&](const SolveOptions& all) {
    detail::OrbitQuestion question =
        detail::question_of(hamiltonian, start, times.at(times.size() - 1), tolerance, all);
    if (deliver) question.times.assign(times.data(), times.data() + times.size());
    if (deliver) detail::require_times(start.t, question.times);
    if (made) question.made = std::make_shared<const Choice>(made->choice);
    if (!choose) return detail::answer(std::move(question));
    detail::OrbitAnswer chosen;
    static_cast<SolutionReport&>(chosen) = detail::choose_for(question);
    return chosen;
  });
}

/// The rest of a run that a file holds.
py::tuple resume(const Formula& hamiltonian, const std::string& file, const SolveOptions& options,
                 const Events& events, const py::object& progress) {
  const VectorX nothing = VectorX::Zero(hamiltonian.inputs() / 2);
  return orbit(hamiltonian, options, events, progress, [&](const SolveOptions& all) {
    return detail::answer_from(
        file, detail::question_of(hamiltonian, State<dynamic>{.q = nothing, .p = nothing}, 0.0, 1e-6, all));
  });
}

/// A function of Python that returns its value and its gradient; not a number after Ctrl-C.
struct Called {
  const py::object& f;
  Signals& signals;

  double operator()(const VectorX& x, VectorX& gradient) const {
    if (signals.pressed) return std::numeric_limits<double>::quiet_NaN();
    const py::gil_scoped_acquire locked;
    try {
      const py::tuple both = f(array_of(x));
      gradient = vector_of(both[1].cast<Numbers>());
      return both[0].cast<double>();
    } catch (const py::error_already_set& error) {
      signals.note(error);
      return (*this)(x, gradient);
    }
  }
};

py::tuple minimise(const py::object& f, const Numbers& x0, MinimiseOptions options,
                   const py::object& callback, bool history) {
  const VectorX start = vector_of(x0);
  Signals signals;
  std::vector<double> rows;
  options.callback = [&](const Progress& progress) {
    if (history)
      rows.insert(rows.end(), {static_cast<double>(progress.gradient_evaluations), progress.value,
                               progress.gradient_norm});
    return tell(
        callback, [&] { return array_of(progress.x); }, signals);
  };
  Minimisation run = [&] {
    const auto* formula = py::isinstance<Formula>(f) ? f.cast<const Formula*>() : nullptr;
    const py::gil_scoped_release unlocked;
    return formula ? avi::minimise(*formula, start, options)
                   : avi::minimise(Called{f, signals}, start, options);
  }();
  if (signals.pressed) run.outcome = Outcome::stopped, run.message = "Stopped by Ctrl-C.";
  return py::make_tuple(run.outcome, run.message, run.iterations, run.gradient_evaluations,
                        array_of(run.last.x), run.last.value, array_of(run.last.gradient),
                        Numbers({static_cast<py::ssize_t>(rows.size() / 3), py::ssize_t{3}}, rows.data()));
}

}  // namespace
}  // namespace avi::python

PYBIND11_MODULE(_avi, module) {
  using namespace avi;
  using namespace avi::python;
  bind_traced(module);
  py::enum_<Outcome> outcome(module, "Outcome");
  for (int i = 0; i <= static_cast<int>(Outcome::time_limit); ++i)
    outcome.value(std::string(name(Outcome{i})).c_str(), Outcome{i});
  py::class_<Formula>(module, "Formula")
      .def_property_readonly("size", &Formula::inputs)
      .def_property_readonly("parameters", &Formula::parameters)
      .def("with_parameters", &Formula::with)
      .def("value", [](const Formula& f, const Numbers& x) { return f.value(vector_of(x)); })
      .def("gradient", [](const Formula& f, const Numbers& x) { return array_of(f.gradient(vector_of(x))); });
  // clang-format off
  py::class_<SolveMonitor>(module, "Monitor").def(py::init<std::string>()).def(py::init<Formula>());
#define AVI_FIELD(name) .def_readwrite(#name, &In::name)
  { using In = Run; py::class_<In>(module, "Run")
    AVI_FIELD(outcome) AVI_FIELD(steps) AVI_FIELD(evaluations) AVI_FIELD(message); }
  { using In = SolveTrial; py::class_<In>(module, "Trial")
    AVI_FIELD(monitor) AVI_FIELD(order) AVI_FIELD(h) AVI_FIELD(time) AVI_FIELD(steps) AVI_FIELD(sweeps)
    AVI_FIELD(state_error) AVI_FIELD(outcome); }
  { using In = Choice; py::class_<In>(module, "Choice")
    .def_readonly("monitor", &In::name) AVI_FIELD(order) AVI_FIELD(h) AVI_FIELD(energy_scale) AVI_FIELD(time)
    AVI_FIELD(sweeps) AVI_FIELD(trials); }
  { using In = SolutionReport; py::class_<In>(module, "Report").def("report", &In::report).def("kept", &In::kept)
    AVI_FIELD(run) AVI_FIELD(choice) AVI_FIELD(tolerance) AVI_FIELD(state_error) AVI_FIELD(energy_error)
    AVI_FIELD(note); }
  { using In = SolveOptions; py::class_<In>(module, "SolveOptions").def(py::init<>())
    AVI_FIELD(seconds) AVI_FIELD(check) AVI_FIELD(sweeps) AVI_FIELD(steps) AVI_FIELD(order) AVI_FIELD(monitor)
    AVI_FIELD(h) AVI_FIELD(dense) AVI_FIELD(checkpoint) AVI_FIELD(checkpoint_seconds); }
  { using In = MinimiseOptions; py::class_<In>(module, "MinimiseOptions").def(py::init<>())
    AVI_FIELD(relative) AVI_FIELD(absolute) AVI_FIELD(change) AVI_FIELD(memory) AVI_FIELD(iterations)
    AVI_FIELD(evaluations) AVI_FIELD(check_gradient); }
#undef AVI_FIELD
  // clang-format on
  using Curve = detail::OrbitCurve;
  py::class_<Curve, std::shared_ptr<Curve>>(module, "Curve")
      .def("times", &Curve::times)
      .def("at", [](const Curve& curve, const Numbers& t, py::ssize_t n) {
        Numbers z({t.size(), n});
        double* to = z.mutable_data();
        const py::gil_scoped_release unlocked;
        for (py::ssize_t i = 0; i < t.size(); ++i)
          curve.at(t.data()[i], to + i * n);
        return z;
      });
  module.attr("__version__") = version();
  module.attr("massless") = massless;
  module.def("trace", trace);
  module.def("solve", python::solve);
  module.def("resume", python::resume);
  module.def("minimise", python::minimise);
}
