#include "generate/latex.hpp"
#include "generate/tables.hpp"

#include "scorecard/shares.hpp"

#include <array>

namespace paper {

std::string claims_table(const experiment::Table& claims) {
  std::string out =
      "\\begin{longtable}{@{}r>{\\raggedright}p{0.33\\textwidth}lp{0.47\\textwidth}@{}}\n\\toprule\n"
      " & claim & ruling & evidence \\\\\n\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n";
  for (std::size_t i = 0; i < claims.rows.size(); ++i)
    out += fmt::format("{} & {} \\textcolor{{grey}}{{({})}} & \\textit{{{}}} & {} \\\\[2pt]\n", i + 1,
                       latex(claims.text(i, "claim")), latex(claims.text(i, "source")),
                       latex(claims.text(i, "ruling")), latex(claims.text(i, "evidence")));
  return out + "\\end{longtable}\n";
}

std::string shares_table(const experiment::Table& card, const experiment::Table& claims) {
  using scorecard::Kind;
  const auto outcomes = scorecard::of_kind(card, Kind::outcome),
             inputs = scorecard::of_kind(card, Kind::input);
  const std::array columns{scorecard::shares(outcomes, "verdict"), scorecard::shares(inputs, "verdict"),
                           scorecard::shares(claims, "ruling")};
  std::string out =
      fmt::format("\\begin{{tabular}}{{@{{}}lrr@{{\\hspace{{2.5em}}}}lrr@{{\\hspace{{2.5em}}}}lrr@{{}}}}\n"
                  "\\toprule\n\\multicolumn{{3}}{{@{{}}l}}{{{} printed outcomes}} & "
                  "\\multicolumn{{3}}{{l}}{{{} printed inputs}} & "
                  "\\multicolumn{{3}}{{l@{{}}}}{{{} claims of the text}} \\\\\n\\midrule\n",
                  outcomes.rows.size(), inputs.rows.size(), claims.rows.size());
  const auto cell = [](const std::vector<scorecard::Share>& list, std::size_t i) {
    return i < list.size() ? fmt::format("\\textit{{{}}} & {} & {}", list[i].name, list[i].count,
                                         latex_number(list[i].part, "pct"))
                           : std::string(" & & ");
  };
  std::size_t lines = 0;
  for (const auto& column : columns)
    lines = std::max(lines, column.size());
  for (std::size_t i = 0; i < lines; ++i)
    out += cell(columns[0], i) + " & " + cell(columns[1], i) + " & " + cell(columns[2], i) + " \\\\\n";
  return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string provenance_table(const experiment::Table& manifest) {
  std::string out = "\\begin{longtable}{@{}lrlll@{}}\n\\toprule\nfile & rows & commit & date & content "
                    "\\\\\n\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n";
  for (std::size_t i = 0; i < manifest.rows.size(); ++i)
    out += fmt::format("\\texttt{{{}}} & {} & \\texttt{{{}}} & {} & \\texttt{{{}}} \\\\\n",
                       escaped(manifest.text(i, "file")), latex_cell(manifest.text(i, "rows"), "int"),
                       escaped(manifest.text(i, "commit")), escaped(manifest.text(i, "date")),
                       manifest.text(i, "content").substr(0, 12));
  return out + "\\end{longtable}\n";
}

}  // namespace paper
