#include "generate/latex.hpp"
#include "generate/tables.hpp"

#include "scorecard/numbers/printed.hpp"
#include "scorecard/shares.hpp"

#include <algorithm>
#include <map>

namespace paper {
namespace {

std::string mark(const std::string& verdict) {
  static const std::map<std::string, std::string> marks{{"exact", ""},
                                                        {"within", "$\\,^{\\approx}$"},
                                                        {"erratum", "$\\,^{\\dagger}$"},
                                                        {"unstated", "$\\,^{\\S}$"},
                                                        {"chaotic", "$\\,^{\\ddagger}$"},
                                                        {"differs", "$\\,^{\\times}$"},
                                                        {"missing", "$\\,^{?}$"}};
  return marks.at(verdict);
}

const std::map<std::string, std::string> headers{{"h", "$h$"},
                                                 {"g_min", "$a$"},
                                                 {"g_max", "$b$"},
                                                 {"min_step", "min.\\ step"},
                                                 {"max_step", "max.\\ step"},
                                                 {"energy_error", "energy err."},
                                                 {"global_error", "global err."},
                                                 {"steps", "steps"},
                                                 {"seconds", "time/SV"},
                                                 {"p", "$p$"},
                                                 {"p_ring", "$\\mathring p$"},
                                                 {"iterations", "iterations"}};

/// Line of the scorecard for a cell.
std::size_t line_of(const experiment::Table& card, const std::string& source, const std::string& row,
                    const std::string& quantity) {
  return scorecard::find(card, {{"source", source}, {"row", row}, {"quantity", quantity}});
}

std::vector<std::string> distinct(const experiment::Table& table, std::string_view column) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (std::ranges::find(found, table.text(i, column)) == found.end())
      found.push_back(table.text(i, column));
  return found;
}

/// Columns in the order of the paper's tables.
std::vector<std::string> quantities(const experiment::Table& published) {
  const auto present = distinct(published, "quantity");
  std::vector<std::string> ordered;
  for (const char* q : {"p", "p_ring", "h", "g_min", "g_max", "min_step", "max_step", "energy_error",
                        "global_error", "steps", "seconds", "iterations"})
    if (std::ranges::find(present, q) != present.end()) ordered.emplace_back(q);
  return ordered;
}

/// A row's name without the settings that have columns of their own.
std::string row_name(const std::string& row) {
  if (row.starts_with("p sweep")) return "$p$ grows";
  if (row.starts_with("p_ring sweep")) return "$\\mathring p$ falls";
  return display_name(row.substr(0, row.find(" p=")));
}

}  // namespace

std::string published_table(const experiment::Table& published, const experiment::Table& card) {
  const std::string source = published.text(0, "source");
  const auto columns = quantities(published);
  const bool timed = std::ranges::find(columns, "seconds") != columns.end();
  const auto unit = [&](const char* column) {
    return card.number(line_of(card, source, "SV", "seconds"), column);
  };
  std::string out = "\\begin{tabular}{@{}ll" + std::string(columns.size(), 'r') + "@{}}\n\\toprule\n & ";
  for (const auto& q : columns)
    out += " & " + headers.at(q);
  out += " \\\\\n";
  for (const auto& row : distinct(published, "row")) {
    std::string printed = row_name(row) + " & printed", ours = " & ours";
    for (const auto& q : columns) {
      printed += " & ", ours += " & ";
      std::size_t line = 0;
      try {
        line = line_of(card, source, row, q);
      } catch (const std::out_of_range&) {
        continue;  // the paper prints a dash
      }
      const std::string verdict = card.text(line, "verdict");
      if (timed && q == "seconds") {
        printed += latex_number(card.number(line, "published") / unit("published"), "g3");
        ours += latex_number(card.number(line, "reproduced") / unit("reproduced"), "g3");
      } else {
        const bool input = scorecard::kind_of(row, q) == scorecard::Kind::input;
        const auto shown = [&](const std::string& number) {
          return input ? "\\textcolor{grey}{" + latex_printed(number) + "}" : latex_printed(number);
        };
        printed += shown(card.text(line, "published"));
        ours +=
            shown(card.text(line, input && verdict == "exact" ? "published" : "reproduced")) + mark(verdict);
      }
    }
    out += "\\midrule\n" + printed + " \\\\\n" + ours + " \\\\\n";
  }
  return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string iteration_table(const experiment::Table& published, const experiment::Table& card) {
  const std::string source = published.text(0, "source");
  std::string out = "\\begin{tabular}{@{}lrrrrr@{}}\n\\toprule\n & $p$ & $\\mathring p$ & $h$ & printed & "
                    "ours \\\\\n\\midrule\n";
  for (const auto& row : distinct(published, "row")) {
    out += row_name(row);
    for (const char* q : {"p", "p_ring", "h"}) {
      out += " & ";
      if (std::string(q) == "p_ring" && row.find("Direct") != std::string::npos) {
        out += "--";
        continue;
      }
      const auto line = line_of(card, source, row, q);
      out += "\\textcolor{grey}{" + latex_printed(card.text(line, "published")) + "}";
      if (const auto verdict = card.text(line, "verdict"); verdict != "exact")
        out += mark(verdict) + " (" + latex_number(card.number(line, "reproduced"), "g2") + ")";
    }
    const auto line = line_of(card, source, row, "iterations");
    out += fmt::format(" & {} & {}{} \\\\\n", latex_printed(card.text(line, "published")),
                       latex_printed(card.text(line, "reproduced")), mark(card.text(line, "verdict")));
  }
  return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string optimiser_table(const experiment::Table& published, const experiment::Table& card) {
  const auto deltas = distinct(published, "delta");
  std::string out =
      "\\begin{tabular}{@{}ll" + std::string(deltas.size(), 'r') + "@{}}\n\\toprule\n & $\\delta=$";
  for (const auto& delta : deltas)
    out += " & " + latex_printed(delta);
  out += " \\\\\n";
  for (const auto& method : distinct(published, "method")) {
    std::string printed, ours;
    std::string title;
    for (const auto& delta : deltas) {
      printed += " & ", ours += " & ";
      for (std::size_t i = 0; i < published.rows.size(); ++i) {
        if (published.text(i, "method") != method || published.text(i, "delta") != delta) continue;
        title = published.text(i, "row").substr(0, published.text(i, "row").find(' '));
        const auto line = line_of(card, "table6", published.text(i, "row"), "iterations");
        printed += latex_printed(published.text(i, "published"));
        ours += latex_printed(card.text(line, "reproduced")) + mark(card.text(line, "verdict"));
      }
    }
    out += "\\midrule\n" + title + " & printed" + printed + " \\\\\n & ours" + ours + " \\\\\n";
  }
  return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string notes_table(const experiment::Table& card) {
  std::string out, group;
  for (std::size_t i = 0; i < card.rows.size(); ++i) {
    const std::string &verdict = card.text(i, "verdict"), &note = card.text(i, "note");
    if (verdict == "exact" || card.text(i, "quantity") == "seconds") continue;
    const std::string table = card.text(i, "source").substr(5);
    out += fmt::format("{} & {}, {} & {} & {} & \\textit{{{}}}", table, latex(card.text(i, "row")),
                       headers.at(card.text(i, "quantity")), latex_printed(card.text(i, "published")),
                       latex_printed(card.text(i, "reproduced")), verdict);
    const bool last = i + 1 == card.rows.size() || card.text(i + 1, "note") != note;
    out += last ? fmt::format("\\\\*\n & \\multicolumn{{4}}{{p{{0.88\\textwidth}}}}{{\\footnotesize {}}}"
                              "\\\\[3pt]\n",
                              latex(note))
                : "\\\\*\n";
  }
  return "\\begin{longtable}{@{}lp{0.4\\textwidth}rrl@{}}\n\\toprule\nTable & cell & printed & ours & "
         "verdict "
         "\\\\\n\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n" +
         out + "\\end{longtable}\n";
}

}  // namespace paper
