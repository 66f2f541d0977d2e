#include "scorecard/numbers/sheet.hpp"

#include "scorecard/numbers/printed.hpp"

#include <cmath>

namespace scorecard {

std::string Cell::elsewhere(std::string_view row, std::string_view quantity) const {
  const auto found = rows(*table_, {{"row", row}, {"quantity", quantity}});
  return found.empty() ? "" : found.front().text("published");
}

Judgement compare(const Cell& cell, double ours, std::string note, double tolerance) {
  const Printed printed(cell.published());
  const Verdict verdict = printed.equals(ours)                   ? Verdict::exact
                          : printed.units_off(ours) <= tolerance ? Verdict::within
                                                                 : Verdict::differs;
  return {.reproduced = beside(cell.published(), ours), .verdict = verdict, .note = std::move(note)};
}

Judgement compare_count(const Cell& cell, double ours, double more, std::string note) {
  Judgement judgement = compare(cell, ours + more, std::move(note));
  judgement.reproduced = beside(cell.published(), ours);
  return judgement;
}

Judgement compare_setting(const Cell& cell, double ours) {
  const double printed = Printed(cell.published()).value;
  return {.reproduced = beside(cell.published(), ours),
          .verdict = std::abs(ours - printed) <= 1e-12 * printed ? Verdict::exact : Verdict::differs,
          .note = {}};
}

std::string settings_of(const std::string& unprinted, bool recovered) {
  if (recovered) return "recovered";
  if (unprinted == "-") return "printed";
  return unprinted == "horizon" || unprinted == "horizon start" ? "customary" : "recovered";
}

std::vector<Line> judge(const Sheet& sheet, const std::filesystem::path& published, const Results& data) {
  const Table table = Table::read(published / (sheet.stem + ".tsv"));
  std::vector<Line> lines;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Cell cell(table, i);
    Judgement judgement;
    try {
      judgement = sheet.judge(cell, data(sheet.stem));
      judgement.unprinted = cell.text("unprinted");
      judgement.settings = settings_of(judgement.unprinted, judgement.recovered);
    } catch (const std::exception& error) {
      judgement.note = error.what();
    }
    lines.push_back({cell.text("source"), cell.text("row"), cell.quantity(), cell.published(), judgement});
  }
  return lines;
}

}  // namespace scorecard
