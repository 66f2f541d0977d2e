#pragma once
#include "scorecard/results.hpp"

#include <string>
#include <string_view>
#include <vector>

/// @file
/// Numbers of the text: each has a name and a formula over the cells of data files, in paper/numbers.tsv.

namespace paper {

/// `stem[conditions]`: the rows of stem.tsv that satisfy all conditions, which have commas between them and
/// are each `column=cell`, with bars between several cells, or `column<number`.
/// @throws std::invalid_argument for a text that cannot be read, and as Results.
std::vector<scorecard::Row> selected(const scorecard::Results& data, std::string_view text);

/// The value of a formula: terms separated by spaces and one of / * + -, taken from left to right. A term is
/// a number, or
///
///   stem[conditions].wanted       the cell of the first row that satisfies the conditions,
///   max:, min:, sum:, median:     before it: over all rows that do (cells that are nan are left out),
///   count:stem[conditions]        how many rows do;
///   place:stem[conditions]        number of the first that does, from 1 on;
///
/// `wanted` is a column, or two with a colon between them for their ratio, or a minus for their difference.
/// @throws std::invalid_argument for a formula that cannot be read, std::out_of_range where no row is found.
double evaluate(const scorecard::Results& data, std::string_view formula);

/// numbers.tex: one \defval{name}{text} for each row of `list` (columns name, formula, format); a formula
/// `head:stem:key` with format `raw` is a line of a file's head.
std::string numbers_tex(const scorecard::Results& data, const experiment::Table& list);

/// Checks the numbers whose sentence has a sense: `senses` has columns name, least, most and sentence.
/// @throws std::runtime_error naming the first one that is not strictly between its bounds, std::out_of_range
/// for a name that `list` does not have.
void check_senses(const scorecard::Results& data, const experiment::Table& list,
                  const experiment::Table& senses);

/// @throws std::runtime_error where the unit of time of a scene moved by more than 5 % while it was measured,
/// as the column `drift` says: what the report would say of its costs would be a statement about the machine.
void refuse_drift(const experiment::Table& advice);

}  // namespace paper
