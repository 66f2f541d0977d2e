#include "generate/latex.hpp"
#include "generate/tables.hpp"
#include "scorecard/shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace paper {
namespace {

using scorecard::Row, scorecard::rows;

std::string mark(const std::string& verdict) {
  static const std::map<std::string, std::string> marks{{"exact", ""},
                                                        {"within", "$\\,^{\\approx}$"},
                                                        {"erratum", "$\\,^{\\dagger}$"},
                                                        {"unstated", "$\\,^{\\S}$"},
                                                        {"chaotic", "$\\,^{\\ddagger}$"},
                                                        {"short run", "$\\,^{\\P}$"},
                                                        {"differs", "$\\,^{\\times}$"},
                                                        {"missing", "$\\,^{?}$"}};
  return marks.at(verdict);
}

/// Columns in the order of the paper's tables, and their headers.
const std::vector<std::pair<std::string, std::string>> headers{{"p", "$p$"},
                                                               {"p_ring", "$\\mathring p$"},
                                                               {"h", "$h$"},
                                                               {"g_min", "$a$"},
                                                               {"g_max", "$b$"},
                                                               {"min_step", "min.\\ step"},
                                                               {"max_step", "max.\\ step"},
                                                               {"energy_error", "energy err."},
                                                               {"global_error", "global err."},
                                                               {"steps", "steps"},
                                                               {"seconds", "time/SV"},
                                                               {"iterations", "iterations"}};

/// Line of the scorecard for a cell.
Row line_of(const experiment::Table& card, const std::string& source, const std::string& row,
            const std::string& quantity) {
  return scorecard::find(card, {{"source", source}, {"row", row}, {"quantity", quantity}});
}

std::vector<std::string> distinct(const experiment::Table& table, std::string_view column) {
  std::vector<std::string> found;
  for (const Row& row : rows(table))
    if (std::ranges::find(found, row.text(column)) == found.end()) found.push_back(row.text(column));
  return found;
}

/// A row's name without the settings that have columns of their own.
std::string row_name(const std::string& row) {
  if (row.starts_with("p sweep")) return "$p$ grows";
  if (row.starts_with("p_ring sweep")) return "$\\mathring p$ falls";
  return display_name(row.substr(0, row.find(" p=")));
}

/// In grey: what a run was given.
std::string given(const std::string& number) { return "\\textcolor{grey}{" + latex_printed(number) + "}"; }

}  // namespace

std::string published_table(const experiment::Table& published, const experiment::Table& card) {
  const std::string source = published.text(0, "source");
  const auto unit = [&](const char* column) { return line_of(card, source, "SV", "seconds").number(column); };
  std::string alignment = "ll", head = " & ";
  for (const auto& [quantity, header] : headers)
    if (!rows(published, {{"quantity", quantity}}).empty()) alignment += 'r', head += " & " + header;
  std::vector<std::string> lines;
  for (const auto& row : distinct(published, "row")) {
    std::string printed = row_name(row) + " & printed", ours = " & ours";
    for (const auto& [quantity, header] : headers) {
      if (rows(published, {{"quantity", quantity}}).empty()) continue;
      printed += " & ", ours += " & ";
      const auto cells = rows(card, {{"source", source}, {"row", row}, {"quantity", quantity}});
      if (cells.empty()) continue;  // the paper prints a dash
      const Row& cell = cells.front();
      const std::string verdict = cell.text("verdict");
      if (quantity == "seconds") {
        printed += latex_number(cell.number("published") / unit("published"), "g2");
        ours += latex_number(cell.number("reproduced") / unit("reproduced"), "g2");
      } else if (cell.text("kind") == "input") {
        printed += given(cell.text("published"));
        ours += given(cell.text(verdict == "exact" ? "published" : "reproduced")) + mark(verdict);
      } else {
        printed += latex_printed(cell.text("published"));
        ours += latex_printed(cell.text("reproduced")) + mark(verdict);
      }
    }
    lines.push_back(printed + " \\\\\n" + ours + " \\\\\n");
  }
  return tabular(alignment, head, fmt::format("{}", fmt::join(lines, "\\midrule\n")));
}

std::string iteration_table(const experiment::Table& published, const experiment::Table& card) {
  const std::string source = published.text(0, "source");
  std::string lines;
  for (const auto& row : distinct(published, "row")) {
    lines += row_name(row);
    for (const char* quantity : {"p", "p_ring", "h"}) {
      lines += " & ";
      if (std::string_view(quantity) == "p_ring" && row.find("Direct") != std::string::npos) {
        lines += "--";
        continue;
      }
      const Row cell = line_of(card, source, row, quantity);
      lines += given(cell.text("published"));
      if (const auto& verdict = cell.text("verdict"); verdict != "exact")
        lines += mark(verdict) + " (" + latex_number(cell.number("reproduced"), "g2") + ")";
    }
    const Row cell = line_of(card, source, row, "iterations");
    lines += fmt::format(
        " & {} & {}{} \\\\\n", latex_printed(cell.text("published")), latex_printed(cell.text("reproduced")),
        mark(cell.text("verdict")) +
            (cell.text("verdict") == "exact" && cell.text("sensitive") == "1" ? "$\\,^{(\\ddagger)}$" : ""));
  }
  return tabular("lrrrrr", " & $p$ & $\\mathring p$ & $h$ & printed & ours", lines);
}

std::string optimiser_table(const experiment::Table& published, const experiment::Table& card) {
  const auto deltas = distinct(published, "delta");
  std::string head = " & $\\delta=$";
  for (const auto& delta : deltas)
    head += " & " + latex_printed(delta);
  std::vector<std::string> lines;
  for (const auto& method : distinct(published, "method")) {
    std::string title, printed, ours;
    for (const auto& delta : deltas) {
      printed += " & ", ours += " & ";
      for (const Row& cell : rows(published, {{"method", method}, {"delta", delta}})) {
        title = cell.text("row").substr(0, cell.text("row").find(' '));
        const Row line = line_of(card, "table6", cell.text("row"), "iterations");
        printed += latex_printed(cell.text("published"));
        ours += latex_printed(line.text("reproduced")) + mark(line.text("verdict"));
      }
    }
    lines.push_back(title + " & printed" + printed + " \\\\\n & ours" + ours + " \\\\\n");
  }
  return tabular("ll" + std::string(deltas.size(), 'r'), head,
                 fmt::format("{}", fmt::join(lines, "\\midrule\n")));
}

std::string notes_table(const experiment::Table& card) {
  std::string lines;
  const auto all = rows(card);
  for (auto line = all.begin(); line != all.end(); ++line) {
    const std::string &verdict = line->text("verdict"), &note = line->text("note");
    if (verdict == "exact" || line->text("quantity") == "seconds") continue;
    const auto header =
        std::ranges::find(headers, line->text("quantity"), &std::pair<std::string, std::string>::first);
    lines +=
        fmt::format("{} & {}, {} & {} & {} & \\textit{{{}}}\\\\*\n", "S" + line->text("source").substr(5),
                    latex(line->text("row")), header->second, latex_printed(line->text("published")),
                    latex_printed(line->text("reproduced")), verdict);
    if (line + 1 == all.end() || (line + 1)->text("note") != note)
      lines += fmt::format(" & \\multicolumn{{4}}{{p{{0.88\\textwidth}}}}{{\\footnotesize {}}}\\\\[3pt]\n",
                           latex(note));
  }
  return longtable("lp{0.4\\textwidth}rrl", "Table & cell & printed & ours & verdict", lines);
}

}  // namespace paper
