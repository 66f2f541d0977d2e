#pragma once
#include "avi/core/compiler.hpp"

#include <cmath>
#include <concepts>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

/// @file
/// Checks of arguments. Each throws std::invalid_argument with one sentence that names the value and the
/// admissible range.

namespace avi {

namespace detail {
/// A number or a text of a sentence. One type for all, so that the sentences are put together in the library
/// and not in every file that says something.
class Piece {
 public:
  ///@{

  /// A number, or a text that outlives it.
  template <std::integral Whole>
  Piece(Whole number) : kind_(std::signed_integral<Whole> ? whole : natural), bits_(number) {}  // NOLINT
  Piece(double number) : kind_(real), real_(number) {}                                          // NOLINT
  Piece(std::string_view text) : kind_(words), text_(text) {}                                   // NOLINT
  Piece(const std::string& text) : Piece(std::string_view(text)) {}                             // NOLINT
  Piece(const char* text) : Piece(std::string_view(text)) {}                                    // NOLINT
  ///@}
  void add_to(std::string& text) const;  ///< Real numbers with as few digits as tell them from all others.

 private:
  enum Kind { whole, natural, real, words } kind_;
  unsigned long long bits_ = 0;
  double real_ = 0.0;
  std::string_view text_;
};
/// The pieces, one after the other.
[[nodiscard]] std::string joined(std::initializer_list<Piece> pieces);
/// @throws std::invalid_argument with a sentence of all that.
[[noreturn]] void reject(std::string_view what, const Piece& value, std::initializer_list<Piece> admissible);
}  // namespace detail

/// Throws unless `holds`; NaN never holds a comparison and so is always refused. What is admissible may be
/// said in several pieces, such as a number of the call; only a refusal puts them together.
template <class Value, class... More>
constexpr void require(bool holds, std::string_view what, const Value& value, std::string_view admissible,
                       const More&... more) {
  if (!holds) detail::reject(what, value, {admissible, more...});
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
