#include "avi/core/require.hpp"

#include <cmath>
#include <sstream>

namespace avi::detail {

void Piece::write(std::ostream& out) const {
  switch (kind_) {
  case whole:
    out << static_cast<long long>(bits_);
    break;
  case natural:
    out << bits_;
    break;
  case real:
    if (std::isnan(real_))
      out << "nan";  // which may have a sign
    else
      out << real_;
    break;
  case words:
    out << text_;
    break;
  }
}

void reject(std::string_view what, const Piece& value, std::initializer_list<Piece> admissible) {
  std::ostringstream sentence;
  sentence.precision(17);
  sentence << what << " is ";
  value.write(sentence);
  sentence << "; it must be ";
  for (const Piece& piece : admissible)
    piece.write(sentence);
  sentence << ".";
  throw std::invalid_argument(sentence.str());
}

}  // namespace avi::detail
