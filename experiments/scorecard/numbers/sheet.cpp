#include "scorecard/numbers/sheet.hpp"

#include "scorecard/numbers/printed.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace scorecard {

std::string_view name(Verdict verdict) {
  static constexpr std::array<std::string_view, verdicts> names{"exact",    "within",  "differs", "erratum",
                                                                "unstated", "chaotic", "missing"};
  return names.at(static_cast<std::size_t>(verdict));
}

std::string_view settings_of(const Judgement& judgement) {
  return judgement.recovered ? "recovered" : "printed";
}

std::string Cell::elsewhere(std::string_view row, std::string_view quantity) const {
  for (std::size_t i = 0; i < table_->rows.size(); ++i)
    if (table_->text(i, "row") == row && table_->text(i, "quantity") == quantity)
      return table_->text(i, "published");
  return {};
}

Judgement compare(const Cell& cell, double ours, std::string note, double tolerance) {
  const Printed printed(cell.published());
  const Verdict verdict = printed.equals(ours)                   ? Verdict::exact
                          : printed.units_off(ours) <= tolerance ? Verdict::within
                                                                 : Verdict::differs;
  return {.reproduced = beside(cell.published(), ours), .verdict = verdict, .note = std::move(note)};
}

bool same(std::string_view a, std::string_view b) {
  if (a == b) return true;
  double x = 0.0, y = 0.0;
  const auto in_a = std::from_chars(a.data(), a.data() + a.size(), x);
  const auto in_b = std::from_chars(b.data(), b.data() + b.size(), y);
  const bool numbers = in_a.ec == std::errc{} && in_b.ec == std::errc{} && in_a.ptr == a.data() + a.size() &&
                       in_b.ptr == b.data() + b.size();
  return numbers && x == y;
}

std::size_t find(const experiment::Table& data,
                 std::initializer_list<std::pair<std::string_view, std::string_view>> wanted) {
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    bool all = true;
    for (const auto& [column, value] : wanted)
      all = all && same(data.text(i, column), value);
    if (all) return i;
  }
  std::string what;
  for (const auto& [column, value] : wanted)
    what += fmt::format("{}{} = {}", what.empty() ? "" : ", ", column, value);
  throw std::out_of_range(fmt::format("The data have no row with {}.", what));
}

std::vector<Line> judge(const Sheet& sheet, const std::filesystem::path& published,
                        const std::filesystem::path& data) {
  const std::string file = sheet.stem + ".tsv";
  const experiment::Table table = experiment::Table::read(published / file);
  std::optional<experiment::Table> ours;
  std::string reason;
  try {
    ours = experiment::Table::read(data / file);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  std::vector<Line> lines;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Cell cell(table, i);
    Judgement judgement{.note = reason};
    if (ours) try {
        judgement = sheet.judge(cell, *ours);
      } catch (const std::exception& error) {
        judgement = {.note = error.what()};
      }
    lines.push_back({cell.text("source"), cell.text("row"), cell.quantity(), cell.published(), judgement});
  }
  return lines;
}

}  // namespace scorecard
