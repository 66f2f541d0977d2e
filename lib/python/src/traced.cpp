#include "traced.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

namespace avi::python {
namespace {

using One = Recorded (*)(const Recorded&);
using Two = Recorded (*)(const Recorded&, const Recorded&);

constexpr const char* no_condition =
    "`&`, `|` and `~` take comparisons such as (a < b) & (c < d), each in brackets.";

/// log(exp(a) + exp(b)), also where they are large; the slopes are right where a = b, too.
Recorded logaddexp(const Recorded& a, const Recorded& b) {
  const Recorded larger = select(a < b, b, a), smaller = select(a < b, a, b);
  return larger + log1p(exp(smaller - larger));
}

// clang-format off
/// Functions of one number by their names in the library, in NumPy and in scipy.special.
const std::map<std::string_view, One> ones = {
#define AVI_ROW(name, value) {#name, [](const Recorded& a) -> Recorded { return value; }},
#define AVI_ONE(name, ...) AVI_ROW(name, name(a))
#define AVI_TWO(...)
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  AVI_ROW(arcsin, asin(a)) AVI_ROW(arccos, acos(a)) AVI_ROW(arctan, atan(a))
  AVI_ROW(arcsinh, asinh(a)) AVI_ROW(arccosh, acosh(a)) AVI_ROW(arctanh, atanh(a))
  AVI_ROW(absolute, abs(a)) AVI_ROW(fabs, abs(a)) AVI_ROW(sign, less(0.0, a) - less(a, 0.0))
  AVI_ROW(negative, -a) AVI_ROW(positive, a) AVI_ROW(conjugate, a)
  AVI_ROW(square, a * a) AVI_ROW(reciprocal, 1.0 / a)
  AVI_ROW(exp2, exp(M_LN2 * a)) AVI_ROW(log2, log(a) / M_LN2) AVI_ROW(log10, log(a) / M_LN10)
  AVI_ROW(deg2rad, (M_PI / 180.0) * a) AVI_ROW(radians, (M_PI / 180.0) * a)
  AVI_ROW(rad2deg, (180.0 / M_PI) * a) AVI_ROW(degrees, (180.0 / M_PI) * a)
  AVI_ROW(expit, 1.0 / (1.0 + exp(-a)))
  AVI_ROW(logical_not, 1.0 - a) AVI_ROW(invert, 1.0 - a)
#undef AVI_ROW
};
/// Functions of two.
const std::map<std::string_view, Two> twos = {
#define AVI_ROW(name, value) {#name, [](const Recorded& a, const Recorded& b) -> Recorded { return value; }},
#define AVI_ONE(...)
#define AVI_TWO(name, ...) AVI_ROW(name, name(a, b))
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  AVI_ROW(add, a + b) AVI_ROW(subtract, a - b) AVI_ROW(multiply, a * b) AVI_ROW(divide, a / b)
  AVI_ROW(power, pow(a, b)) AVI_ROW(float_power, pow(a, b)) AVI_ROW(arctan2, atan2(a, b))
  AVI_ROW(maximum, max(a, b)) AVI_ROW(minimum, min(a, b)) AVI_ROW(fmax, max(a, b)) AVI_ROW(fmin, min(a, b))
  AVI_ROW(logaddexp, logaddexp(a, b))
  AVI_ROW(less, less(a, b)) AVI_ROW(less_equal, less_equal(a, b))
  AVI_ROW(greater, less(b, a)) AVI_ROW(greater_equal, less_equal(b, a))
  AVI_ROW(logical_and, when(a, b)) AVI_ROW(bitwise_and, when(a, b))
  AVI_ROW(logical_or, max(a, b)) AVI_ROW(bitwise_or, max(a, b))
#undef AVI_ROW
};
// clang-format on

bool of_conditions(std::string_view name) {
  return name.starts_with("logical") || name.starts_with("bitwise") || name == "invert";
}
bool gives_conditions(std::string_view name) {
  return of_conditions(name) || name.starts_with("less") || name.starts_with("greater");
}

py::object numpy(const char* name) { return py::module_::import("numpy").attr(name); }

/// The numbers of the entries, in x's shape: what NumPy does with them can be done with x.
py::object numbers(const Traced& x) {
  return numpy("arange")(x.entries.size()).attr("reshape")(py::cast(x.shape));
}

/// The entries with these numbers, in the shape of the numbers.
Traced take(const Traced& x,
            const py::array_t<py::ssize_t, py::array::c_style | py::array::forcecast>& which) {
  Traced result{x.graph, {}, {which.shape(), which.shape() + which.ndim()}, x.condition};
  for (py::ssize_t i = 0; i < which.size(); ++i)
    result.entries.push_back(x.entries.at(static_cast<std::size_t>(which.data()[i])));
  return result;
}

/// x in another shape, by NumPy's rules; x itself where it has that shape.
const Traced& broadcast(const Traced& x, const Shape& shape, Traced& room) {
  return x.shape == shape ? x : room = take(x, numpy("broadcast_to")(numbers(x), shape));
}

/// A traced array, number, array or list as an operand; `room` holds it where it was none.
const Traced& operand(py::handle x, Traced& room) {
  if (py::isinstance<Traced>(x)) return x.cast<const Traced&>();
  if (PyFloat_Check(x.ptr()) || PyLong_Check(x.ptr())) {
    const double number = PyFloat_AsDouble(x.ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
    room.entries.assign(1, number);
    return room;
  }
  const py::array array = py::array::ensure(x);
  const char kind = array ? array.dtype().kind() : '?';
  if (!array || std::string_view("biufO").find(kind) == std::string_view::npos) {
    PyErr_Clear();
    throw py::type_error("A traced number meets a " +
                         std::string(py::str(py::type::handle_of(x).attr("__name__"))) +
                         "; it can be combined with real numbers and arrays of them.");
  }
  room.shape.assign(array.shape(), array.shape() + array.ndim());
  room.entries.reserve(static_cast<std::size_t>(array.size()));
  if (kind == 'O') {
    for (const py::handle each : array.attr("ravel")()) {
      if (py::isinstance<py::array>(each)) throw py::type_error("Rows of an array are of different lengths.");
      Traced own;
      const Traced& entry = operand(each, own);
      if (entry.graph) room.graph = entry.graph;
      room.condition = entry.condition;
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
  Traced result{a.graph, {}, a.shape};
  result.entries.reserve(a.entries.size());
  for (const Recorded& x : a.entries)
    result.entries.push_back(f(x));
  return result;
}

Traced apply(Two f, const Traced& a, const Traced& b) {
  Traced result{a.graph ? a.graph : b.graph, {}, a.shape.empty() ? b.shape : a.shape}, left_room, right_room;
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

/// A function of the tables at its operands.
Traced call(std::string_view name, py::handle a, py::handle b = {}) {
  Traced left_room, right_room;
  const Traced& left = operand(a, left_room);
  const Traced& right = b ? operand(b, right_room) : right_room;
  if (of_conditions(name) && !(left.condition && (!b || right.condition))) throw py::type_error(no_condition);
  Traced result = b ? apply(twos.find(name)->second, left, right) : apply(ones.find(name)->second, left);
  result.condition = gives_conditions(name);
  return result;
}

/// x where the condition holds, else y: what select() of the library records.
Traced where(py::handle condition, py::handle x, py::handle y) {
  Traced c_room, x_room, y_room;
  const Traced& c = operand(condition, c_room);
  if (!c.condition && c.graph) throw py::type_error("where() takes a comparison first, such as a < b.");
  const Two both = twos.at("logical_and"), sum = twos.at("add");
  return apply(sum, apply(both, c, operand(x, x_room)),
               apply(both, apply(ones.at("invert"), c), operand(y, y_room)));
}

/// f(f(x[0], x[1]), x[2]) ... along the first axis, f a function of the table.
Traced fold(std::string_view name, const Traced& x) {
  const auto length = static_cast<std::size_t>(x.shape.at(0));
  if (length == 0 && name != "add" && name != "multiply")
    throw py::value_error("There is no largest entry of none.");
  Traced result{x.graph, {}, {x.shape.begin() + 1, x.shape.end()}};
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
  if (left.shape.size() != 1 || left.shape != right.shape)
    return py::module_::import("avi._algebra").attr("product")(left, right);
  return py::cast(fold("add", apply(twos.at("multiply"), left, right)));
}

Traced item(const Traced& x, const py::object& key) {
  if (PyLong_Check(key.ptr()) && !x.shape.empty()) {
    py::ssize_t i = key.cast<py::ssize_t>();
    const py::ssize_t length = x.shape[0];
    if (i < -length || i >= length)
      throw py::index_error("Index " + std::to_string(i) + " of an array of " + std::to_string(length) +
                            " entries.");
    if (i < 0) i += length;
    const auto each = static_cast<py::ssize_t>(x.entries.size()) / length;
    const auto first = x.entries.begin() + i * each;
    return {x.graph, {first, first + each}, {x.shape.begin() + 1, x.shape.end()}, x.condition};
  }
  return take(x, py::array(numbers(x)[key]));
}

/// The numbers of the arguments that the entries are; empty where they are anything else.
std::vector<int> places(const Traced& x) {
  std::vector<int> found;
  for (const Recorded& entry : x.entries) {
    const int node = x.graph ? entry.node_in(*x.graph) : -1;
    if (node < 0 || node >= x.graph->inputs()) return {};
    found.push_back(node);
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
  for (const py::object& part : parts) {
    Traced room;
    const Traced& x = operand(part, room);
    if (x.graph) all.graph = x.graph;
    all.condition = x.condition;
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
  if (value.entries.size() != 1)
    throw py::type_error(std::string(what) + " returned an array of shape " +
                         std::string(py::str(py::tuple(py::cast(value.shape)))) +
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
      .def("_folded", [](const Traced& x, const std::string& name) { return fold(name, x); })
      .def("_take", take)
      .def("_more", more)
      .def_property_readonly("_places", places)
      .def_property_readonly("_numbers", numbers)
      .def_property_readonly("shape", [](const Traced& x) { return py::tuple(py::cast(x.shape)); })
      .def_property_readonly("size", [](const Traced& x) { return x.entries.size(); });
  module.def("where", where);
  module.def("pool", pool);
  module.def("traced", [](const py::object& x) {
    Traced room;
    return Traced(operand(x, room));
  });
}

}  // namespace avi::python
