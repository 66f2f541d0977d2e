#include "scorecard/shares.hpp"

#include "scorecard/claims/claims.hpp"
#include "scorecard/numbers/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scorecard {

std::string_view name(Kind kind) {
  return kind == Kind::outcome ? "outcome" : kind == Kind::input ? "input" : "seconds";
}

Kind kind_of(std::string_view row, std::string_view quantity) {
  if (quantity == "seconds") return Kind::seconds;
  for (const char* setting : {"h", "p", "p_ring", "g_min", "g_max"})
    if (quantity == setting) return Kind::input;
  const bool fixed_steps = row == "SV" || row == "HTVI4 none";
  return fixed_steps && (quantity == "min_step" || quantity == "max_step") ? Kind::input : Kind::outcome;
}

experiment::Table of_kind(const experiment::Table& cells, Kind kind) {
  experiment::Table found = cells;
  const auto row_column = cells.column("row"), quantity = cells.column("quantity");
  std::erase_if(found.rows, [&](const auto& row) { return kind_of(row[row_column], row[quantity]) != kind; });
  return found;
}

std::vector<Share> shares(const experiment::Table& table, std::string_view column) {
  std::vector<std::string> names;
  for (int v = 0; v < verdicts; ++v)
    names.emplace_back(name(static_cast<Verdict>(v)));
  for (int r = 0; r < rulings; ++r)
    if (std::string ruling(name(static_cast<Ruling>(r))); std::ranges::find(names, ruling) == names.end())
      names.push_back(ruling);
  std::vector<Share> found;
  for (const std::string& each : names) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      count += table.text(i, column) == each;
    if (count > 0)
      found.push_back({each, count, static_cast<double>(count) / static_cast<double>(table.rows.size())});
  }
  return found;
}

std::size_t predicted(const experiment::Table& cells) {
  const experiment::Table outcomes = of_kind(cells, Kind::outcome);
  std::size_t count = 0;
  for (std::size_t i = 0; i < outcomes.rows.size(); ++i)
    count += outcomes.text(i, "verdict") == "exact" && outcomes.text(i, "settings") == "printed";
  return count;
}

std::string summary(std::string_view what, const std::vector<Share>& shares) {
  std::size_t all = 0;
  std::string out;
  for (const Share& share : shares) {
    out += fmt::format("{} {} {} ({:.1f} %)", out.empty() ? ":" : ",", share.count, share.name,
                       100.0 * share.part);
    all += share.count;
  }
  return fmt::format("{} {}{}.", all, what, out);
}

}  // namespace scorecard
