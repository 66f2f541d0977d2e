#include "traced.hpp"
#include "named_functions.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

namespace avi::python {
namespace {

using Places = py::array_t<py::ssize_t, py::array::c_style | py::array::forcecast>;

constexpr const char* no_condition =
    "`&`, `|` and `~` take comparisons such as (a < b) & (c < d), each in brackets.";

constexpr const char* no_count = "NumPy takes a + b and a @ b of comparisons for one comparison, not for how "
                                 "many hold: write `|` for that, "
                                 "or 1.0 * (a < b) for a number.";

bool of_conditions(std::string_view name) {
  return name.starts_with("logical") || name.starts_with("bitwise") || name == "invert";
}
bool gives_conditions(std::string_view name) {
  return of_conditions(name) || name.starts_with("less") || name.starts_with("greater");
}

py::object numpy(const char* name) { return py::module_::import("numpy").attr(name); }

std::string text(const Shape& shape) { return py::str(py::tuple(py::cast(shape))); }

/// The numbers of the entries, in x's shape: what NumPy does with them can be done with x.
py::object numbers(const Traced& x) {
  return numpy("arange")(x.entries.size()).attr("reshape")(py::cast(x.shape));
}

/// The entries with these numbers, in the shape of the numbers.
Traced take(const Traced& x, const Places& which) {
  Traced result{x.graph, {}, {which.shape(), which.shape() + which.ndim()}, x.condition, x.regular};
  for (py::ssize_t i = 0; i < which.size(); ++i)
    result.entries.push_back(x.entries.at(static_cast<std::size_t>(which.data()[i])));
  return result;
}

/// x with what has been assigned to it, as a view or through one.
const Traced& current(Traced& x) {
  if (!x.cells || x.seen == x.cells->version) return x;
  x.graph = x.cells->graph, x.seen = x.cells->version;
  for (std::size_t i = 0; i < x.entries.size(); ++i)
    x.entries[i] = x.cells->entries[x.places[i]];
  return x;
}

/// The cells of x, made for the first of its views.
Cells& cells_of(Traced& x) {
  if (!x.cells) {
    x.cells = std::make_shared<Cells>(Cells{x.graph, x.entries});
    x.places.resize(x.entries.size());
    std::iota(x.places.begin(), x.places.end(), std::size_t{0});
  }
  return *x.cells;
}

/// As take(), with entries that are those of x whatever is assigned to either.
Traced view(Traced& x, const Places& which) {
  Traced result = take(current(x), which);
  const auto steps_alike = [at = which.data(), count = which.size()] {
    for (py::ssize_t i = 2; i < count; ++i)
      if (at[i] - at[i - 1] != at[1] - at[0]) return false;
    return true;
  };
  result.regular = which.ndim() < 2 || (x.regular && steps_alike());
  if (x.shape.empty() && !x.cells) {  // a number of NumPy never changes: an array of it is a copy
    cells_of(result);
    return result;
  }
  result.seen = cells_of(x).version, result.cells = x.cells;
  for (py::ssize_t i = 0; i < which.size(); ++i)
    result.places.push_back(x.places[static_cast<std::size_t>(which.data()[i])]);
  return result;
}

/// Whether the entries lie side by side, in their order: only then is ravel() a view.
bool in_a_row(const Traced& x) {
  for (std::size_t i = 1; i < x.places.size(); ++i)
    if (x.places[i] != x.places[0] + i) return false;
  return x.regular;
}

/// x, with other entries: what x += y does to an array.
void assign(Traced& x, const Traced& value) {
  if (value.shape != x.shape)
    throw py::value_error("An array of the shape " + text(x.shape) + " cannot hold one of the shape " +
                          text(value.shape) + ": write a = a + b instead of a += b.");
  if (value.condition != x.condition)
    throw py::type_error("An array of comparisons cannot hold numbers: write a = a + b instead of a += b.");
  if (x.cells) {
    std::vector<std::size_t> once = x.places;
    std::sort(once.begin(), once.end());
    if (x.cells->fixed || std::adjacent_find(once.begin(), once.end()) != once.end())
      throw py::type_error("This array cannot be changed, since np.asarray(), np.broadcast_to() or a "
                           "reshape() that may be a copy has made "
                           "another of it that would not follow: write a = a + b instead of a += b.");
    x.cells->graph = x.graph ? x.graph : value.graph, x.seen = ++x.cells->version;
    for (std::size_t i = 0; i < x.places.size(); ++i)
      x.cells->entries[x.places[i]] = value.entries[i];
  }
  if (!x.graph) x.graph = value.graph;
  x.entries = value.entries;
}

/// x in another shape, by NumPy's rules; x itself where it has that shape.
const Traced& broadcast(const Traced& x, const Shape& shape, Traced& room) {
  return x.shape == shape ? x : room = take(x, numpy("broadcast_to")(numbers(x), shape));
}

/// A traced array, number, array or list as an operand; `room` holds it where it was none.
const Traced& operand(py::handle x, Traced& room) {
  if (py::isinstance<Traced>(x)) return current(x.cast<Traced&>());
  if (PyFloat_Check(x.ptr()) || PyLong_Check(x.ptr())) {
    const double number = PyFloat_AsDouble(x.ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
    room.entries.assign(1, number);
    room.condition = PyBool_Check(x.ptr());
    return room;
  }
  const py::array array = py::array::ensure(x);
  char kind = array ? array.dtype().kind() : '?';
  if (kind == 'O' && array.ndim() == 0 && !py::isinstance<py::array>(x)) {  // an object that is no array
    const double number = PyFloat_AsDouble(x.ptr());                        // of a Fraction, for one
    if (!PyErr_Occurred()) {
      room.entries.assign(1, number);
      return room;
    }
    kind = '?';
  }
  if (!array || std::string_view("biufO").find(kind) == std::string_view::npos) {
    PyErr_Clear();
    throw py::type_error(
        "A traced number meets " +
        (kind == 'c' ? "complex numbers"
                     : "a " + std::string(py::str(py::type::handle_of(x).attr("__name__")))) +
        "; it can be combined with real numbers and arrays of them." +
        (kind == 'c' ? " Keep real and imaginary parts apart: |q + i p|^2 is q**2 + p**2." : ""));
  }
  if (py::hasattr(x, "hardmask"))
    throw py::type_error(
        "A traced number meets an array with a mask, which would be lost: write a.filled(0.0) "
        "or a.data.");
  if (py::hasattr(x, "getA1"))
    throw py::type_error(
        "A traced number meets an np.matrix, whose * and ** are products of matrices, and would not be here: "
        "write np.asarray(a), and a @ b for products.");
  room.shape.assign(array.shape(), array.shape() + array.ndim());
  room.regular = (array.flags() & py::array::c_style) != 0 || array.ndim() < 2;
  room.entries.reserve(static_cast<std::size_t>(array.size()));
  if (kind == 'O') {
    room.condition = array.size() > 0;
    for (const py::handle each : array.attr("ravel")()) {
      Traced own;
      const Traced& entry = operand(each, own);
      if (py::isinstance<py::array>(each) || !entry.shape.empty())
        throw py::type_error(
            "An entry of an array of objects is an array; np.stack([u, v]) makes one array of several.");
      if (entry.graph) room.graph = entry.graph;
      room.condition = room.condition && entry.condition;
      room.entries.push_back(entry.entries[0]);
    }
  } else {
    room.condition = kind == 'b';
    const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
    room.entries.assign(numbers.data(), numbers.data() + numbers.size());
  }
  return room;
}

Traced apply(One f, const Traced& a) {
  Traced result{a.graph, {}, a.shape, false, a.regular};
  result.entries.reserve(a.entries.size());
  for (const Recorded& x : a.entries)
    result.entries.push_back(f(x));
  return result;
}

Traced apply(Two f, const Traced& a, const Traced& b) {
  Traced result{a.graph ? a.graph : b.graph, {}, a.shape.empty() ? b.shape : a.shape}, left_room, right_room;
  result.regular = a.regular && b.regular;
  if (!a.shape.empty() && !b.shape.empty() && a.shape != b.shape)
    result.shape = numpy("broadcast_shapes")(a.shape, b.shape).cast<Shape>();
  const auto& left = a.shape.empty() ? a.entries : broadcast(a, result.shape, left_room).entries;
  const auto& right = b.shape.empty() ? b.entries : broadcast(b, result.shape, right_room).entries;
  const std::size_t in_left = a.shape.empty() ? 0 : 1, in_right = b.shape.empty() ? 0 : 1;
  const std::size_t size = in_left ? left.size() : in_right ? right.size() : 1;
  result.entries.reserve(size);
  for (std::size_t i = 0; i < size; ++i)
    result.entries.push_back(f(left[i * in_left], right[i * in_right]));
  return result;
}

/// Whether a node is a sum of squares and of numbers that are not negative; no where it takes long to see.
bool is_sum_of_squares(const ExpressionGraph& graph, int node) {
  std::vector<int> parts{node};
  for (int left = graph.size(); !parts.empty() && left > 0; --left) {
    const ExpressionGraph::Node& part = graph[parts.back()];
    parts.pop_back();
    const bool square = part.operation == Operation::multiply && part.a == part.b;
    if (part.operation == Operation::add)
      parts.insert(parts.end(), {part.a, part.b});
    else if (!square && !(part.operation == Operation::constant && part.number >= 0.0))
      return false;
  }
  return parts.empty();
}

/// The square of x. That of a norm is the sum below its root, as the root has no slopes at 0, where a body is
/// at rest.
Recorded square(const Recorded& x, ExpressionGraph& graph) {
  const ExpressionGraph::Node node = graph[x.node_in(graph)];
  if (node.operation == Operation::sqrt && is_sum_of_squares(graph, node.a)) return {graph, node.a};
  if (node.operation != Operation::hypot) return x * x;
  const Recorded a(graph, node.a), b(graph, node.b);
  return a * a + b * b;
}

/// Whether a function of the tables is the square of its first operand.
bool is_square(std::string_view name, const Traced& left, const Traced& right) {
  return left.graph && (name == "square" || ((name == "power" || name == "float_power") && !right.graph &&
                                             right.shape.empty() && right.entries[0] == 2.0));
}

/// A function of the tables at its operands.
Traced call(std::string_view name, py::handle a, py::handle b = {}) {
  Traced left_room, right_room;
  const Traced& left = operand(a, left_room);
  const Traced& right = b ? operand(b, right_room) : right_room;
  if (of_conditions(name) && !(left.condition && (!b || right.condition))) throw py::type_error(no_condition);
  if ((name == "add" || name == "subtract") && left.condition && right.condition)
    throw py::type_error(no_count);
  if (is_square(name, left, right)) {
    Traced squares{left.graph, {}, left.shape, false, left.regular};
    for (const Recorded& x : left.entries)
      squares.entries.push_back(square(x, *left.graph));
    return squares;
  }
  Traced result = b ? apply(twos.find(name)->second, left, right) : apply(ones.find(name)->second, left);
  result.condition = gives_conditions(name);
  return result;
}

/// x where the condition holds, else y: what select() of the library records. A number that is not traced
/// holds unless it is 0.
Traced where(py::handle condition, py::handle x, py::handle y) {
  Traced c_room, x_room, y_room;
  operand(condition, c_room);
  const py::object holds = py::isinstance<Traced>(condition) || c_room.graph || c_room.condition
                               ? py::reinterpret_borrow<py::object>(condition)
                               : py::object(numpy("not_equal")(condition, 0));
  const Traced& c = operand(holds, c_room = {});
  if (!c.condition) throw py::type_error("where() takes a comparison first, such as a < b.");
  const Two both = twos.at("logical_and"), sum = twos.at("add");
  return apply(sum, apply(both, c, operand(x, x_room)),
               apply(both, apply(ones.at("invert"), c), operand(y, y_room)));
}

/// f(f(x[0], x[1]), x[2]) ... along the first axis, f a function of the table.
Traced fold(std::string_view name, const Traced& x) {
  const auto length = static_cast<std::size_t>(x.shape.at(0));
  if (length == 0 && name != "add" && name != "multiply")
    throw py::value_error("There is no largest entry of none.");
  Traced result{x.graph, {}, {x.shape.begin() + 1, x.shape.end()}, false, x.regular};
  const auto each = static_cast<std::size_t>(size_of(result.shape));
  for (std::size_t i = 0; i < each; ++i) {
    Recorded total = length > 0 ? x.entries[i] : Recorded(name == "multiply" ? 1.0 : 0.0);
    for (std::size_t k = 1; k < length; ++k)
      total = twos.find(name)->second(total, x.entries[k * each + i]);
    result.entries.push_back(total);
  }
  return result;
}

/// a @ b; that of vectors is here, as it is in many formulas.
py::object product(const py::object& a, const py::object& b) {
  Traced left_room, right_room;
  const Traced &left = operand(a, left_room), &right = operand(b, right_room);
  if (left.condition && right.condition) throw py::type_error(no_count);
  if (left.shape.size() != 1 || left.shape != right.shape)
    return py::module_::import("avi._algebra").attr("product")(left, right);
  return py::cast(fold("add", apply(twos.at("multiply"), left, right)));
}

/// Whether NumPy answers x[key] with a view.
bool gives_view(const py::handle& key) {
  if (py::isinstance<py::tuple>(key)) {
    const auto parts = py::reinterpret_borrow<py::tuple>(key);
    return std::all_of(parts.begin(), parts.end(), gives_view);
  }
  return py::isinstance<py::slice>(key) || py::isinstance<py::ellipsis>(key) || key.is_none() ||
         (PyIndex_Check(key.ptr()) && !PyBool_Check(key.ptr()) && !py::isinstance<py::array>(key));
}

bool names_ellipsis(const py::handle& key) {
  return py::isinstance<py::ellipsis>(key) ||
         (py::isinstance<py::tuple>(key) && std::any_of(key.begin(), key.end(), names_ellipsis));
}

Traced item(Traced& x, const py::object& key) {
  if (PyLong_Check(key.ptr()) && !PyBool_Check(key.ptr()) && !x.shape.empty()) {
    py::ssize_t i = PyNumber_AsSsize_t(key.ptr(), PyExc_IndexError);
    if (PyErr_Occurred()) throw py::error_already_set();
    const py::ssize_t length = x.shape[0];
    if (i < -length || i >= length)
      throw py::index_error("Index " + std::to_string(i) + " of an array of " + std::to_string(length) +
                            " entries.");
    if (i < 0) i += length;
    if (x.shape.size() > 1) return view(x, py::array(numbers(x)[key]));
    return {x.graph, {current(x).entries[static_cast<std::size_t>(i)]}, {}, x.condition};
  }
  if (py::isinstance<Traced>(key))
    throw py::type_error(
        "x[a < b] asks which entries there are, which depends on numbers that have no value yet: "
        "write avi.where(a < b, x, 0.0), with as many entries as x.");
  const py::array which = numbers(x)[key];
  return gives_view(key) && (which.ndim() > 0 || names_ellipsis(key)) ? view(x, which)
                                                                      : take(current(x), which);
}

/// The numbers of the arguments that the entries are; empty where they are anything else.
std::vector<int> places(const Traced& x) {
  std::vector<int> found;
  for (const Recorded& entry : x.entries) {
    const int node = x.graph ? entry.node_in(*x.graph) : -1;
    if (node < 0 || (*x.graph)[node].operation != Operation::input) return {};
    found.push_back((*x.graph)[node].a);
  }
  return found;
}

/// More arguments beside x: see ExpressionGraph::late_input().
Traced more(const Traced& x, const Shape& shape) {
  Traced late{x.graph, {}, shape};
  for (py::ssize_t i = size_of(shape); i > 0; --i)
    late.entries.emplace_back(*x.graph, x.graph->late_input());
  return late;
}

/// The entries of several arrays, one after the other.
Traced pool(const std::vector<py::object>& parts) {
  Traced all;
  all.condition = !parts.empty();
  for (const py::object& part : parts) {
    Traced room;
    const Traced& x = operand(part, room);
    if (x.graph) all.graph = x.graph;
    all.condition = all.condition && x.condition;
    all.regular = all.regular && x.regular;
    all.entries.insert(all.entries.end(), x.entries.begin(), x.entries.end());
  }
  all.shape = {static_cast<py::ssize_t>(all.entries.size())};
  return all;
}

}  // namespace

py::ssize_t size_of(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), py::ssize_t{1}, std::multiplies<>());
}

Traced inputs(const std::shared_ptr<ExpressionGraph>& graph, int first, Shape shape) {
  Traced x{graph, {}, std::move(shape)};
  for (int i = 0; i < static_cast<int>(size_of(x.shape)); ++i)
    x.entries.emplace_back(*graph, first + i);
  return x;
}

int returned_node(const py::object& result, ExpressionGraph& graph, const char* what) {
  if (result.is_none())
    throw py::type_error(std::string(what) +
                         " returned None; it must return one number: is `return` missing?");
  Traced room;
  const Traced& value = operand(result, room);
  if (value.condition)
    throw py::type_error(
        std::string(what) +
        " returned a comparison; it must return a number: avi.where(a < b, x, y) makes one of "
        "it, and an event is the zero of a difference, such as a - b.");
  if (value.entries.size() != 1)
    throw py::type_error(std::string(what) + " returned an array of shape " + text(value.shape) +
                         "; it must return one number: is np.sum() missing?");
  return value.entries[0].node_in(graph);
}

void bind_traced(py::module_& module) {
  py::class_<Traced> traced(module, "Traced");
  py::list names;
  for (const auto& [name, f] : ones) {
    traced.def(name.data(), [name](const py::object& a) { return call(name, a); });
    names.append(name.data());
  }
  for (const auto& [name, f] : twos) {
    const std::string reversed = "reversed_" + std::string(name);
    traced.def(name.data(), [name](const py::object& a, const py::object& b) { return call(name, a, b); });
    traced.def(reversed.c_str(),
               [name](const py::object& b, const py::object& a) { return call(name, a, b); });
    names.append(name.data());
  }
  module.attr("functions") = names;
  traced.def("__matmul__", product)
      .def("__rmatmul__", [](const py::object& b, const py::object& a) { return product(a, b); })
      .def("__getitem__", item)
      .def("_folded", [](Traced& x, const std::string& name) { return fold(name, current(x)); })
      .def("_take", [](Traced& x, const Places& which) { return take(current(x), which); })
      .def("_view", view)
      .def("_assign",
           [](Traced& x, const py::object& value) {
             Traced room;
             assign(x, operand(value, room));
           })
      .def("_fix",
           [](Traced& x) {
             if (!x.shape.empty() || x.cells) cells_of(x).fixed = true;
           })
      .def("_more", more)
      .def_readonly("_regular", &Traced::regular)
      .def_property_readonly("_in_a_row", in_a_row)
      .def_property_readonly("_is_view", [](const Traced& x) { return x.cells != nullptr; })
      .def_property_readonly("_places", [](Traced& x) { return places(current(x)); })
      .def_property_readonly("_numbers", numbers)
      .def_property_readonly("shape", [](const Traced& x) { return py::tuple(py::cast(x.shape)); })
      .def_property_readonly("size", [](const Traced& x) { return x.entries.size(); });
  module.def("where", where);
  module.def("pool", pool);
  module.def("traced", [](const py::object& x) {
    Traced room;
    const Traced& value = operand(x, room);
    return Traced{value.graph, value.entries, value.shape, value.condition, value.regular};
  });
}

}  // namespace avi::python
