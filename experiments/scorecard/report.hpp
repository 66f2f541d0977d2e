#pragma once
#include "scorecard/numbers/sheet.hpp"

/// @file
/// The scorecard as people read it on a terminal.

namespace scorecard {

/// One table: how many cells have which verdict, then every cell that is not exact, with its note. Cells of
/// one row with the same verdict and note share a line.
std::string report(const std::string& title, const std::vector<Line>& lines);

/// "41 published numbers: 33 exact, 1 within, ...".
std::string summary(const std::vector<Line>& lines);

}  // namespace scorecard
