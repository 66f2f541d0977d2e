#pragma once
#include "avi/autodiff/recorded.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <vector>

/// @file
/// The numbers that a Python function is called with while its formula is recorded.

namespace avi::python {

namespace py = pybind11;
using Shape = std::vector<py::ssize_t>;  ///< The shape of an array, as NumPy has it.

/// The numbers that an array and its views share, so that each sees what is assigned to the other.
struct Cells {
  std::shared_ptr<ExpressionGraph> graph{};  ///< As of Traced.
  std::vector<Recorded> entries{};           ///< Those of the array itself.
  long version = 0;                          ///< How often something was assigned.
  bool fixed = false;                        ///< NumPy has a copy, which would not see an assignment.
};

/// Recorded numbers in the shape of a NumPy array. NumPy hands its functions over to it (__array_ufunc__,
/// __array_function__), so that a formula reads as it does for an array of doubles, and every entry of what
/// comes out is one node of the graph.
struct Traced {
  std::shared_ptr<ExpressionGraph> graph{};  ///< Keeps the nodes alive; none where all entries are numbers.
  std::vector<Recorded> entries{};           ///< Last index first, as NumPy has them in C order.
  Shape shape{};                             ///< Empty for a single number.
  bool condition = false;                    ///< The entries are 1 or 0, from comparisons.
  bool regular = true;             ///< NumPy reshapes it without a copy: its entries lie at equal distances.
  std::shared_ptr<Cells> cells{};  ///< Cells of an array that has views, and of these.
  std::vector<std::size_t> places{};  ///< Where in the cells the entries are.
  long seen = 0;                      ///< The version of the cells that the entries are of.
};

/// `count` arguments of the graph from `first` on, in a shape of so many entries.
Traced inputs(const std::shared_ptr<ExpressionGraph>& graph, int first, Shape shape);

/// The number of entries of an array.
py::ssize_t size_of(const Shape& shape);

/// The value that H or f returned, as a node. @throws py::type_error where it is no single number; `what` was
/// called.
int returned_node(const py::object& result, ExpressionGraph& graph, const char* what);

/// Adds the class to the module.
void bind_traced(py::module_& module);

}  // namespace avi::python
