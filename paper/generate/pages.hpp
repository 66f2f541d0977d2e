#pragma once
#include "scorecard/results.hpp"

#include <map>
#include <string>
#include <string_view>

/// @file
/// Numbers in pages of Markdown: `<!--= name -->123<!--/-->` shows 123 in every browser and says where it
/// comes from.

namespace paper {

/// A number for people, as plain text. Formats: `int`, `f<n>` (n decimals), `g<n>` (n significant digits,
/// with an exponent where it is very small or large), `pct` (per cent of 1).
/// @throws std::invalid_argument for another format.
std::string plain_number(double value, std::string_view format);

/// The numbers of a page by name, as the page has them.
std::map<std::string, std::string> numbers_on(const std::string& page);

/// The page with the numbers that `texts` has in the place of its own.
std::string with_numbers(const std::string& page, const std::map<std::string, std::string>& texts);

/// The texts of all numbers of a list (columns name, formula, format) whose data are there.
std::map<std::string, std::string> plain_numbers(const scorecard::Results& data,
                                                 const experiment::Table& list);

}  // namespace paper
