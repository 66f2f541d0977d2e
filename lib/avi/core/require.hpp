#pragma once
#include "avi/core/finite_math.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

/// @file
/// Checks of arguments. Each throws std::invalid_argument with one sentence that names the value and the
/// admissible range.

namespace avi {

namespace detail {
template <class Value, class... More>
[[noreturn]] void reject(std::string_view what, const Value& value, std::string_view admissible,
                         const More&... more) {
  std::ostringstream sentence;
  sentence.precision(17);
  sentence << what << " is " << value << "; it must be " << admissible;
  (sentence << ... << more) << ".";
  throw std::invalid_argument(sentence.str());
}
}  // namespace detail

/// Throws unless `holds`; NaN never holds a comparison and so is always refused. What is admissible may be
/// said in several pieces, such as a number of the call; only a refusal puts them together.
template <class Value, class... More>
constexpr void require(bool holds, std::string_view what, const Value& value, std::string_view admissible,
                       const More&... more) {
  if (!holds) detail::reject(what, value, admissible, more...);
}

/// Throws unless value is finite and > 0; returns it.
inline double require_positive(std::string_view what, double value) {
  require(std::isfinite(value) && value > 0.0, what, value, "finite and positive");
  return value;
}

/// Throws unless value is finite; returns it.
inline double require_finite(std::string_view what, double value) {
  require(std::isfinite(value), what, value, "finite");
  return value;
}

}  // namespace avi
