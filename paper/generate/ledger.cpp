#include "generate/latex.hpp"
#include "generate/tables.hpp"

#include "scorecard/shares.hpp"

namespace paper {

std::string claims_table(const avi::Table& claims) {
  std::string out =
      "\\begin{longtable}{@{}r>{\\raggedright}p{0.31\\textwidth}lp{0.47\\textwidth}@{}}\n\\toprule\n"
      " & claim & ruling & evidence \\\\\n\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n";
  for (std::size_t i = 0; i < claims.rows.size(); ++i)
    out += fmt::format("{} & {} \\textcolor{{grey}}{{({})}} & \\textit{{{}}} & {} \\\\[2pt]\n", i + 1,
                       latex(claims.text(i, "claim")), latex(claims.text(i, "source")),
                       latex(claims.text(i, "ruling")), latex(claims.text(i, "evidence")));
  return out + "\\end{longtable}\n";
}

std::string shares_table(const avi::Table& card, const avi::Table& claims) {
  const auto numbers = scorecard::shares(card, "verdict"), rulings = scorecard::shares(claims, "ruling");
  std::string out = "\\begin{tabular}{@{}lrr@{\\hspace{3em}}lrr@{}}\n\\toprule\n";
  out +=
      fmt::format("\\multicolumn{{3}}{{@{{}}l}}{{{} published numbers}} & \\multicolumn{{3}}{{l@{{}}}}{{{} "
                  "claims of the text}} \\\\\n\\midrule\n",
                  card.rows.size(), claims.rows.size());
  const auto half = [](const std::vector<scorecard::Share>& list, std::size_t i) {
    return i < list.size() ? fmt::format("\\textit{{{}}} & {} & {}", list[i].name, list[i].count,
                                         latex_number(list[i].part, "pct"))
                           : std::string(" & & ");
  };
  for (std::size_t i = 0; i < std::max(numbers.size(), rulings.size()); ++i)
    out += half(numbers, i) + " & " + half(rulings, i) + " \\\\\n";
  return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string provenance_table(const avi::Table& manifest) {
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
