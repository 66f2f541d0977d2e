#include "generate/tables.hpp"

#include "generate/latex.hpp"
#include "generate/numbers.hpp"
#include "scorecard/shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace paper {

using scorecard::Row;

std::string tabular(const std::string& alignment, const std::string& head, const std::string& lines) {
  return fmt::format("\\begin{{tabular}}{{@{{}}{}@{{}}}}\n\\toprule\n{} \\\\\n\\midrule\n{}\\bottomrule\n"
                     "\\end{{tabular}}\n",
                     alignment, head, lines);
}

std::string longtable(const std::string& alignment, const std::string& head, const std::string& lines) {
  return fmt::format("\\begin{{longtable}}{{@{{}}{}@{{}}}}\n\\toprule\n{} \\\\\n\\midrule\n\\endhead\n"
                     "\\bottomrule\n\\endfoot\n{}\\end{{longtable}}\n",
                     alignment, head, lines);
}

std::string claims_table(const experiment::Table& claims) {
  std::string lines;
  int number = 0;
  for (const Row& claim : scorecard::rows(claims))
    lines += fmt::format("{} & {} \\textcolor{{grey}}{{({})}} & \\textit{{{}}} & {} \\\\[2pt]\n", ++number,
                         latex(claim.text("claim")), latex(claim.text("source")), latex(claim.text("ruling")),
                         latex(claim.text("evidence")));
  return longtable("r>{\\raggedright}p{0.32\\textwidth}lp{0.46\\textwidth}", " & claim & ruling & evidence",
                   lines);
}

std::string shares_table(const experiment::Table& card, const experiment::Table& claims) {
  using scorecard::Kind, scorecard::of_kind, scorecard::shares;
  const auto outcomes = of_kind(card, Kind::outcome), inputs = of_kind(card, Kind::input);
  const std::array columns{shares(outcomes, "verdict"), shares(inputs, "verdict"), shares(claims, "ruling")};
  std::string lines;
  for (std::size_t i = 0; i < std::max({columns[0].size(), columns[1].size(), columns[2].size()}); ++i) {
    std::vector<std::string> cells;
    for (const auto& column : columns)
      cells.push_back(i < column.size() ? fmt::format("\\textit{{{}}} & {} & {}", column[i].name,
                                                      column[i].count, latex_number(column[i].part, "pct"))
                                        : " & & ");
    lines += fmt::format("{} \\\\\n", fmt::join(cells, " & "));
  }
  return tabular("lrr@{\\hspace{2.5em}}lrr@{\\hspace{2.5em}}lrr",
                 fmt::format("\\multicolumn{{3}}{{@{{}}l}}{{{} printed outcomes}} & "
                             "\\multicolumn{{3}}{{l}}{{{} printed inputs}} & "
                             "\\multicolumn{{3}}{{l@{{}}}}{{{} claims of the text}}",
                             outcomes.rows.size(), inputs.rows.size(), claims.rows.size()),
                 lines);
}

std::string declared_table(const scorecard::Results& data, const experiment::Table& list,
                           const std::string& name) {
  const auto columns = scorecard::rows(list, {{"table", name}});
  const std::string& selection = columns.at(0).text("rows");
  std::string alignment, lines;
  std::vector<std::string> head;
  for (const Row& column : columns) {
    const std::string& format = column.text("format");
    alignment += format == "text" || format == "raw" || format == "yes" ? 'l' : 'r';
    head.push_back(column.text("header"));
  }
  for (const Row& row : selected(data, selection)) {
    std::vector<std::string> cells;
    for (const Row& column : columns)
      cells.push_back(latex_cell(row.text(column.text("column")), column.text("format")));
    lines += fmt::format("{} \\\\\n", fmt::join(cells, " & "));
  }
  if (lines.empty()) throw std::out_of_range(fmt::format("Table '{}' has no row of {}.", name, selection));
  return tabular(alignment, fmt::format("{}", fmt::join(head, " & ")), lines);
}

}  // namespace paper
