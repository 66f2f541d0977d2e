#include "generate/latex.hpp"
#include "generate/tables.hpp"

#include <algorithm>

namespace paper {
namespace {

/// `column=a|b;column=c`: every column holds one of its cells.
bool satisfies(const experiment::Table& table, std::size_t row, std::string_view conditions) {
  while (!conditions.empty()) {
    const auto semicolon = std::min(conditions.find(';'), conditions.size());
    std::string_view condition = conditions.substr(0, semicolon);
    conditions.remove_prefix(std::min(semicolon + 1, conditions.size()));
    const auto equals = condition.find('=');
    if (equals == std::string_view::npos) throw std::invalid_argument("A condition has no =.");
    const std::string& cell = table.text(row, condition.substr(0, equals));
    condition.remove_prefix(equals + 1);
    bool found = false;
    while (!condition.empty()) {
      const auto bar = std::min(condition.find('|'), condition.size());
      found = found || scorecard::same(cell, condition.substr(0, bar));
      condition.remove_prefix(std::min(bar + 1, condition.size()));
    }
    if (!found) return false;
  }
  return true;
}

}  // namespace

std::string declared_table(const scorecard::Results& data, const experiment::Table& list,
                           const std::string& name) {
  std::string stem, where, alignment, header;
  std::vector<std::pair<std::string, std::string>> columns;
  for (std::size_t i = 0; i < list.rows.size(); ++i) {
    if (list.text(i, "table") != name) continue;
    stem = list.text(i, "stem");
    where = list.text(i, "where");
    const std::string& format = list.text(i, "format");
    columns.emplace_back(list.text(i, "column"), format);
    alignment += format == "text" || format == "raw" || format == "yes" ? 'l' : 'r';
    header += (columns.size() > 1 ? " & " : "") + list.text(i, "header");
  }
  const experiment::Table& table = data(stem);
  std::string out =
      fmt::format("\\begin{{tabular}}{{@{{}}{}@{{}}}}\n\\toprule\n{} \\\\\n\\midrule\n", alignment, header);
  std::size_t count = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!satisfies(table, i, where == "all" ? "" : where)) continue;
    ++count;
    for (std::size_t c = 0; c < columns.size(); ++c)
      out += (c ? " & " : "") + latex_cell(table.text(i, columns[c].first), columns[c].second);
    out += " \\\\\n";
  }
  if (count == 0) throw std::out_of_range(fmt::format("Table '{}' has no row in {}.tsv.", name, stem));
  return out + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace paper
