#pragma once
#include "scorecard/results.hpp"

#include <string>

/// @file
/// Tables of the paper as LaTeX.

namespace paper {

/// A tabular: alignment of the columns, cells of its head, and lines.
std::string tabular(const std::string& alignment, const std::string& head, const std::string& lines);

/// Same, for a table that may take several pages.
std::string longtable(const std::string& alignment, const std::string& head, const std::string& lines);

/// A published table, two lines for each of its rows: as printed, and ours with the mark of its verdict.
/// Seconds become multiples of the Stormer-Verlet row's, printed and ours. `card` is
/// build/data/scorecard.tsv.
std::string published_table(const experiment::Table& published, const experiment::Table& card);

/// Tables S3 to S5, one line for each row: settings, printed count and ours, verdict of the count, a mark
/// where an exact one moves with the last bits; a setting that is a slip has ours in parentheses.
std::string iteration_table(const experiment::Table& published, const experiment::Table& card);

/// Table S6: methods against tolerances.
std::string optimiser_table(const experiment::Table& published, const experiment::Table& card);

/// Every cell that is not exact, seconds left out, with the note that says why.
std::string notes_table(const experiment::Table& card);

/// The ledger of claims.
std::string claims_table(const experiment::Table& claims);

/// Verdicts on outcomes and on inputs, and rulings on claims, with their shares.
std::string shares_table(const experiment::Table& card, const experiment::Table& claims);

/// A table that paper/tables.tsv declares: some columns of some rows of a data file.
std::string declared_table(const scorecard::Results& data, const experiment::Table& list,
                           const std::string& name);

}  // namespace paper
