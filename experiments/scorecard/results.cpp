#include "scorecard/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace scorecard {

bool same(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const auto x = experiment::number_in(a), y = experiment::number_in(b);
  return x && y && *x == *y;
}

std::vector<Row> rows(const Table& table, Cells wanted) {
  std::vector<Row> found;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (std::ranges::all_of(wanted,
                            [&](const auto& cell) { return same(table.text(i, cell.first), cell.second); }))
      found.emplace_back(table, i);
  return found;
}

Row find(const Table& table, Cells wanted) {
  const std::vector<Row> found = rows(table, wanted);
  if (!found.empty()) return found.front();
  std::string what;
  for (const auto& [column, value] : wanted)
    what += fmt::format("{}{} = {}", what.empty() ? "" : ", ", column, value);
  throw std::out_of_range(fmt::format("The data have no row with {}.", what));
}

const Table& Results::operator()(const std::string& stem) const {
  const auto known = tables_.find(stem);
  if (known != tables_.end()) return known->second;
  for (const auto& folder : folders_)
    if (const auto file = folder / (stem + ".tsv"); std::filesystem::exists(file))
      return tables_.emplace(stem, Table::read(file)).first->second;
  throw std::runtime_error("There are no data " + stem + ".tsv.");
}

}  // namespace scorecard
