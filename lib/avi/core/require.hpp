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
/// range allowed.

namespace avi {

namespace detail {
/// A number or text as part of an error message. There is one type for all, so that messages are assembled in
/// the compiled library and not in every file that contains a check.
class Piece {
 public:
  ///@{

  /// A number, or a text that must outlive this object.
  template <std::integral Whole>
  Piece(Whole number) : kind_(std::signed_integral<Whole> ? whole : natural), bits_(number) {}  // NOLINT
  Piece(double number) : kind_(real), real_(number) {}                                          // NOLINT
  Piece(std::string_view text) : kind_(words), text_(text) {}                                   // NOLINT
  Piece(const std::string& text) : Piece(std::string_view(text)) {}                             // NOLINT
  Piece(const char* text) : Piece(std::string_view(text)) {}                                    // NOLINT
  ///@}
  /// Appends it to a text; real numbers with the fewest digits that identify them.
  void add_to(std::string& text) const;

 private:
  enum Kind { whole, natural, real, words } kind_;
  unsigned long long bits_ = 0;
  double real_ = 0.0;
  std::string_view text_;
};
/// Joins the pieces to one text.
[[nodiscard]] std::string joined(std::initializer_list<Piece> pieces);
/// @throws std::invalid_argument with a sentence made of these parts.
[[noreturn]] void reject(std::string_view what, const Piece& value, std::initializer_list<Piece> admissible);
}  // namespace detail

/// Throws std::invalid_argument unless `holds`. A comparison with NaN never holds, so NaN is always refused.
/// The description of the admissible range may consist of several pieces, which are joined only on failure.
template <class Value, class... More>
constexpr void require(bool holds, std::string_view what, const Value& value, std::string_view admissible,
                       const More&... more) {
  if (!holds) detail::reject(what, value, {admissible, more...});
}

/// Throws std::invalid_argument unless the value is finite and > 0; returns the value.
inline double require_positive(std::string_view what, double value) {
  require(std::isfinite(value) && value > 0.0, what, value, "finite and positive");
  return value;
}

/// Throws std::invalid_argument unless the value is finite; returns the value.
inline double require_finite(std::string_view what, double value) {
  require(std::isfinite(value), what, value, "finite");
  return value;
}

}  // namespace avi
