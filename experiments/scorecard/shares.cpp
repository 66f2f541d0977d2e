#include "scorecard/shares.hpp"

#include "scorecard/claims/claims.hpp"
#include "scorecard/numbers/sheet.hpp"

#include <algorithm>

namespace scorecard {

std::string_view name(Kind kind) {
  return kind == Kind::outcome ? "outcome" : kind == Kind::input ? "input" : "seconds";
}

static bool has_fixed_steps(std::string_view row) { return row == "SV" || row == "HTVI4 none"; }

Kind kind_of(std::string_view row, std::string_view quantity) {
  if (quantity == "seconds") return Kind::seconds;
  for (const char* setting : {"h", "p", "p_ring", "g_min", "g_max"})
    if (quantity == setting) return Kind::input;
  const bool is_step = quantity == "min_step" || quantity == "max_step";
  return is_step && has_fixed_steps(row) ? Kind::input : Kind::outcome;
}

Table of_kind(const Table& cells, Kind kind) {
  Table found = cells;
  const auto row_column = cells.column("row"), quantity = cells.column("quantity");
  std::erase_if(found.rows, [&](const auto& row) { return kind_of(row[row_column], row[quantity]) != kind; });
  return found;
}

std::vector<Share> shares(const Table& table, std::string_view column) {
  std::vector<std::string_view> names(verdicts.begin(), verdicts.end());
  std::ranges::copy_if(rulings, std::back_inserter(names), [](auto name) { return name != "missing"; });
  std::vector<Share> found;
  for (const auto name : names)
    if (const auto count = rows(table, {{column, name}}).size(); count > 0)
      found.push_back({std::string(name), count, 1.0 * count / table.rows.size()});
  return found;
}

std::size_t predicted(const Table& cells) {
  return rows(of_kind(cells, Kind::outcome), {{"verdict", "exact"}, {"settings", "printed"}}).size();
}

std::size_t customary(const Table& cells) {
  auto found = of_kind(cells, Kind::outcome);
  // The steps of a row with fixed steps, of which the horizon was found, follow from nothing else.
  const auto row = found.column("row"), quantity = found.column("quantity");
  std::erase_if(found.rows,
                [&](const auto& cell) { return cell[quantity] == "steps" && has_fixed_steps(cell[row]); });
  return rows(found, {{"verdict", "exact"}, {"settings", "customary"}}).size();
}

std::string summary(std::string_view what, const std::vector<Share>& shares, bool with_parts) {
  std::size_t all = 0;
  std::vector<std::string> each;
  for (const Share& share : shares) {
    all += share.count;
    each.push_back(fmt::format("{} {}", share.count, share.name));
    if (with_parts) each.back() += fmt::format(" ({:.1f} %)", 100.0 * share.part);
  }
  return fmt::format("{} {}: {}.", all, what, fmt::join(each, ", "));
}

}  // namespace scorecard
