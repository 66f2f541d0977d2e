#pragma once
#include <string>
#include <string_view>

/// @file
/// Text and numbers as LaTeX.

namespace paper {

/// Plain text with LaTeX's special characters escaped.
std::string escaped(std::string_view text);

/// The same for prose: also p_ring as a symbol and numbers such as 1e-10 as powers
/// of ten.
std::string latex(std::string_view text);

/// A number for people. Formats: `int`, `plain` (as short as it is), `f<n>` (n decimals), `r<n>` (an integer
/// with n digits that are not 0), `g<n>` (n significant digits, as a power of ten where it is very small or
/// large), `pct` (per cent of 1).
/// @throws std::invalid_argument for another format.
std::string latex_number(double value, std::string_view format);

/// A number as it was printed, such as `1.43E-05` or `>1E10`: the same digits.
std::string latex_printed(std::string_view printed);

/// The name that text, figures and code share for a method, monitor, approach ... of a data file.
std::string display_name(std::string_view name);

/// A cell of a data file: by its format, `text` for a name, `raw` for text as it is and `yes` for
/// yes or no.
std::string latex_cell(const std::string& cell, std::string_view format);

}  // namespace paper
