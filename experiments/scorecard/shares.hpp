#pragma once
#include "scorecard/results.hpp"

#include <string>
#include <string_view>
#include <vector>

// How many numbers or claims got which verdict: the shares that terminal, paper and README state.

namespace scorecard {

/// The kind of a published number: a setting that the run is given, a result, or seconds of another machine.
enum class Kind { outcome, input, seconds };

/// The name used in data files.
std::string_view name(Kind kind);

/// An input is h, p, p_ring, a bound of a monitor, or the smallest and largest step of a row with fixed
/// steps.
Kind kind_of(std::string_view row, std::string_view quantity);

/// The rows of a table with columns `row` and `quantity` whose numbers are of one kind.
Table of_kind(const Table& cells, Kind kind);

/// One verdict or ruling.
struct Share {
  std::string name;
  std::size_t count;
  double part;  ///< of all
};

/// The values of a table's column in the order of Verdict and Ruling, those that do not occur left out.
std::vector<Share> shares(const Table& table, std::string_view column);

/// How many outcomes are exact in runs whose every setting is printed: predictions, where the others judge a
/// fit.
std::size_t predicted(const Table& cells);

/// How many outcomes are exact in runs of which only the start and the horizon are not printed; without the
/// numbers of fixed steps, which are the horizon over h.
std::size_t customary(const Table& cells);

/// "227 published numbers: 196 exact, ...", with or without their parts in per cent.
std::string summary(std::string_view what, const std::vector<Share>& shares, bool with_parts = false);

}  // namespace scorecard
