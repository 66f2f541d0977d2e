#include "common/frame.hpp"
#include "scorecard/claims/claims.hpp"
#include "scorecard/numbers/sheet.hpp"
#include "scorecard/shares.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

// Every published number beside ours, with a verdict and a note: build/data/scorecard.tsv; every claim of
// the text with a ruling and the numbers it rests on: build/data/scorecard_claims.tsv.

namespace {

using namespace scorecard;

/// @throws std::runtime_error where a published table has no sheet.
void require_sheets(const std::filesystem::path& published) {
  const auto sheets = scorecard::sheets();
  for (const auto& entry : std::filesystem::directory_iterator(published))
    if (const std::string stem = entry.path().stem();
        entry.path().extension() == ".tsv" && stem != "claims" &&
        std::ranges::find(sheets, stem, &Sheet::stem) == sheets.end())
      throw std::runtime_error(fmt::format("No sheet judges '{}'.", entry.path().string()));
}

constexpr std::ptrdiff_t listed_singly = 9;  ///< Longer groups with one verdict and note are counted.

/// The words of a text in lines of at most 110 columns, each indented by four.
std::string wrapped(const std::string& text) {
  std::string out, line;
  std::istringstream words(text);
  for (std::string word; words >> word; line += ' ' + word)
    if (line.size() + 4 + word.size() > 110) out += "   " + line + '\n', line.clear();
  return line.empty() ? out : out + "   " + line + '\n';
}

/// Lines of the scorecard: how many cells have which verdict, then every cell that is not exact, with its
/// note. Cells that follow each other with one verdict and note share the note.
std::string report(const std::string& title, const Table& lines) {
  std::string out = fmt::format("\n{} - {}\n", title, summary("published numbers", shares(lines, "verdict")));
  const auto all = rows(lines);
  for (auto first = all.begin(); first != all.end();) {
    const std::string &verdict = first->text("verdict"), &note = first->text("note");
    const auto last = std::find_if(first, all.end(), [&](const Row& line) {
      return line.text("verdict") != verdict || line.text("note") != note;
    });
    const auto cell = [](const Row& line) { return line.text("row") + ' ' + line.text("quantity"); };
    if (verdict != "exact") {
      if (last - first > listed_singly)
        out += fmt::format("  {:<9} {} cells, {} to {}\n", verdict, last - first, cell(*first),
                           cell(*(last - 1)));
      else
        for (auto line = first; line != last; ++line)
          out += fmt::format("  {:<9} {:<24} {:<13} printed {:<10} ours {}\n", verdict, line->text("row"),
                             line->text("quantity"), line->text("published"), line->text("reproduced"));
      out += wrapped(note);
    }
    first = last;
  }
  return out;
}

/// The ledger of claims; what is not held has its evidence.
std::string report_claims(const Table& ledger) {
  std::string out = fmt::format("\nClaims of the text - {}\n", summary("claims", shares(ledger, "ruling")));
  for (const Row& line : rows(ledger)) {
    out += fmt::format("  {:<9} {:<14} {}\n", line.text("ruling"), line.text("source"), line.text("claim"));
    if (line.text("ruling") != "holds") out += wrapped(line.text("evidence"));
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path published = "paper/published", data = "build/data";
  const std::vector<experiment::Option> options{{"--published", &published, "Folder of the paper's numbers"},
                                                {"--data", &data, "Folder of the experiments' tables"}};
  const char* shows = "Compares every number that the paper prints with ours.";
  return experiment::run(argc, argv, shows, options, [&](experiment::Frame& frame) {
    require_sheets(published);
    const Results results({data});
    Table& cells = frame.table({"source", "row", "quantity", "published", "reproduced", "verdict", "note",
                                "kind", "settings", "unprinted", "sensitive"});
    cells.note("sensitive", "starts moved by 1e-14 give other counts");
    cells.note("settings", "customary: of the run's settings only the start and the horizon are not printed; "
                           "recovered: another one was found by printed outcomes");
    for (const Sheet& sheet : sheets()) {
      Table lines(cells.columns);
      for (const auto& [source, row, quantity, printed, judgement] : judge(sheet, published, results))
        lines.row(source, row, quantity, printed, judgement.reproduced, name(judgement.verdict),
                  judgement.note, name(kind_of(row, quantity)), judgement.settings, judgement.unprinted,
                  judgement.sensitive);
      fmt::print("{}", report(sheet.title, lines));
      cells.rows.insert(cells.rows.end(), lines.rows.begin(), lines.rows.end());
    }
    Table& claims =
        frame.table("claims", {"source", "key", "claim", "experiment", "test", "ruling", "evidence"});
    for (const auto& [source, key, claim, experiment, test, finding] : judge_claims(published, results))
      claims.row(source, key, claim, experiment, test, name(finding.ruling), finding.evidence);
    fmt::print("{}", report_claims(claims));
    Table ledger({"source", "row", "quantity", "verdict", "settings"});
    for (const Row& cell : rows(cells))
      ledger.row(cell.text("source"), cell.text("row"), cell.text("quantity"), cell.text("verdict"),
                 cell.text("settings"));
    for (const Row& claim : rows(claims))
      ledger.row("text", claim.text("key"), "claim", claim.text("ruling"), "");
    frame.write(ledger, "verdicts");
    const auto all_of = [&](const char* what, Kind kind) {
      return summary(what, shares(of_kind(cells, kind), "verdict"), true);
    };
    fmt::print(
        "\nAll outcomes - {}\n{} of the exact ones follow from printed settings alone, {} more from these "
        "and the customary start and horizon.\nAll inputs - {}\nAll seconds - {}\nAll claims - {}\n",
        all_of("printed outcomes", Kind::outcome), predicted(cells), customary(cells),
        all_of("printed inputs", Kind::input), all_of("printed seconds", Kind::seconds),
        summary("claims of the text", shares(claims, "ruling"), true));
    const auto missing = rows(cells, {{"verdict", "missing"}}).size(),
               unruled = rows(claims, {{"ruling", "missing"}}).size();
    if (missing + unruled == 0) return;
    frame.write_tables();  // for all that
    throw std::runtime_error(fmt::format(
        "{} published numbers and {} claims have no data to judge them by; see above.", missing, unruled));
  });
}
