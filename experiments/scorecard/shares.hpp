#pragma once
#include "avi/io/table.hpp"

#include <string>
#include <string_view>
#include <vector>

/// @file
/// How many numbers or claims got which verdict: the one source of the shares that terminal, paper and README
/// state.

namespace scorecard {

/// One verdict or ruling.
struct Share {
  std::string name;
  std::size_t count;
  double part;  ///< of all
};

/// The values of a table's column in the order of Verdict and Ruling, those that do not occur left out.
std::vector<Share> shares(const avi::Table& table, std::string_view column);

/// "227 published numbers: 196 exact (86.3 %), ...".
std::string summary(std::string_view what, const std::vector<Share>& shares);

}  // namespace scorecard
