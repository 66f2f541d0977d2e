#include "traced.hpp"

#include "avi/optim/minimise.hpp"
#include "avi/solve.hpp"

#include <pybind11/stl.h>

#include <chrono>
#include <limits>
#include <string>
#include <utility>

/// @file
/// The module avi._avi: formulas of Python's functions, and the library's front doors. What makes them
/// pleasant is in Python (lib/python/avi).

namespace avi::python {
namespace {

/// Doubles in C order.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;

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
  int count = 0;
  for (const Shape& shape : shapes)
    count += static_cast<int>(size_of(shape));
  require(count > 0, "Number of arguments to record", count, "at least 1");
  const auto graph = std::make_shared<ExpressionGraph>(count + static_cast<int>(parameters.size()));
  py::list arguments;
  int first = 0;
  for (const Shape& shape : shapes) {
    arguments.append(inputs(graph, first, shape));
    first += static_cast<int>(size_of(shape));
  }
  if (!parameters.empty())
    arguments.append(inputs(graph, count, {static_cast<py::ssize_t>(parameters.size())}));
  const int node = returned_node(f(*arguments), *graph, name);
  return {*graph, node, std::move(parameters)};
}

py::tuple solve(const Formula& hamiltonian, const Numbers& q, const Numbers& p, double t, double t_end,
                double tolerance, const SolveOptions& options) {
  const State<dynamic> start{.q = vector_of(q), .p = vector_of(p), .t = t};
  const auto found = [&] {
    const py::gil_scoped_release unlocked;
    return avi::solve(hamiltonian, start, t_end, tolerance, options);
  }();
  return py::make_tuple(SolutionReport(found), found.state.t, array_of(found.state.q),
                        array_of(found.state.p));
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

/// Calls a callback, if there is one. False where it raises StopIteration, or after Ctrl-C.
bool tell(const py::object& callback, const VectorX& x, Signals& signals) {
  if (!callback.is_none()) {
    const py::gil_scoped_acquire locked;
    try {
      callback(array_of(x));
    } catch (const py::error_already_set& error) {
      if (error.matches(PyExc_StopIteration)) return false;
      signals.note(error);
    }
  }
  return !signals.interrupted();
}

py::tuple minimise(const py::object& f, const Numbers& x0, MinimiseOptions options,
                   const py::object& callback, bool history) {
  const VectorX start = vector_of(x0);
  Signals signals;
  std::vector<double> rows;
  options.callback = [&](const Progress& progress) {
    if (history)
      rows.insert(rows.end(), {static_cast<double>(progress.gradient_evaluations), progress.value,
                               progress.gradient_norm});
    return tell(callback, progress.x, signals);
  };
  Minimisation run = [&] {
    if (!py::isinstance<Formula>(f)) {
      const py::gil_scoped_release unlocked;
      return avi::minimise(Called{f, signals}, start, options);
    }
    const auto& formula = f.cast<const Formula&>();
    const py::gil_scoped_release unlocked;
    return avi::minimise(RecordedObjective(formula, start.size()), start, options);
  }();
  if (signals.pressed) run.outcome = Outcome::stopped, run.message = "Stopped by Ctrl-C.";
  return py::make_tuple(run.outcome, run.message, run.iterations, run.gradient_evaluations,
                        array_of(run.last.x), run.last.value, array_of(run.last.gradient),
                        Numbers({static_cast<py::ssize_t>(rows.size() / 3), py::ssize_t{3}}, rows.data()));
}

/// A class of fields. @param fields a name and a member, and so on
template <class T, class... Fields>
py::class_<T> record(py::module_& module, const char* name, Fields... fields) {
  py::class_<T> type(module, name);
  type.def(py::init<>());
  const auto add = [&type](auto& self, const char* field, auto member, auto... more) {
    type.def_readwrite(field, member);
    if constexpr (sizeof...(more) > 0) self(self, more...);
  };
  add(add, fields...);
  return type;
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
  record<Run>(module, "Run", "outcome", &Run::outcome, "steps", &Run::steps, "evaluations", &Run::evaluations,
              "message", &Run::message);
  record<SolveTrial>(module, "Trial", "monitor", &SolveTrial::monitor, "order", &SolveTrial::order, "h", &SolveTrial::h,
                     "time", &SolveTrial::time, "steps", &SolveTrial::steps, "sweeps", &SolveTrial::sweeps,
                     "state_error", &SolveTrial::state_error, "outcome", &SolveTrial::outcome);
  record<Choice>(module, "Choice", "monitor", &Choice::name, "order", &Choice::order, "h", &Choice::h,
                 "energy_scale", &Choice::energy_scale, "sweeps", &Choice::sweeps, "trials", &Choice::trials);
  record<SolveOptions>(module, "SolveOptions", "seconds", &SolveOptions::seconds, "check", &SolveOptions::check,
                       "sweeps", &SolveOptions::sweeps);
  record<MinimiseOptions>(module, "MinimiseOptions", "relative", &MinimiseOptions::relative,
                          "absolute", &MinimiseOptions::absolute, "change", &MinimiseOptions::change,
                          "memory", &MinimiseOptions::memory, "iterations", &MinimiseOptions::iterations,
                          "evaluations", &MinimiseOptions::evaluations,
                          "check_gradient", &MinimiseOptions::check_gradient);
  record<SolutionReport>(module, "Report", "run", &SolutionReport::run, "choice", &SolutionReport::choice,
                         "tolerance", &SolutionReport::tolerance, "state_error", &SolutionReport::state_error,
                         "energy_error", &SolutionReport::energy_error, "note", &SolutionReport::note)
      .def("report", &SolutionReport::report).def("kept", &SolutionReport::kept);
  // clang-format on
  module.def("trace", trace);
  module.def("solve", python::solve);
  module.def("minimise", python::minimise);
}
