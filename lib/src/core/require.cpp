#include "avi/core/require.hpp"

#include <charconv>
#include <cmath>

namespace avi::detail {

void Piece::add_to(std::string& text) const {
  char digits[32];
  char* end = digits;
  switch (kind_) {
  case whole:
    end = std::to_chars(digits, std::end(digits), static_cast<long long>(bits_)).ptr;
    break;
  case natural:
    end = std::to_chars(digits, std::end(digits), bits_).ptr;
    break;
  case real: {
    double read = std::nan("");
    for (int precision = 15; precision <= 17 && read != real_; ++precision) {
      // A nan is written without its sign.
      end = std::to_chars(digits, std::end(digits), std::isnan(real_) ? std::abs(real_) : real_,
                          std::chars_format::general, precision)
                .ptr;
      std::from_chars(digits, end, read);
    }
    break;
  }
  case words:
    text += text_;
    break;
  }
  text.append(digits, end);
}

std::string joined(std::initializer_list<Piece> pieces) {
  std::string text;
  for (const Piece& piece : pieces)
    piece.add_to(text);
  return text;
}

void reject(std::string_view what, const Piece& value, std::initializer_list<Piece> admissible) {
  throw std::invalid_argument(joined({what, " is ", value, "; it must be "}) + joined(admissible) + ".");
}

}  // namespace avi::detail
