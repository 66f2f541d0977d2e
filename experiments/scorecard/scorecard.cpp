#include "common/frame.hpp"
#include "scorecard/claims/claims.hpp"
#include "scorecard/numbers/sheets.hpp"
#include "scorecard/report.hpp"
#include "scorecard/shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

/// @file
/// Every published number beside ours, with a verdict and a note: build/data/scorecard.tsv; every claim of
/// the text with a ruling and the numbers it rests on: build/data/scorecard_claims.tsv.

namespace {

/// Lines of a published table that no sheet judges: missing, every one.
std::vector<scorecard::Line> unjudged(const std::string& stem, const std::filesystem::path& published) {
  const auto refuse = [](const scorecard::Cell&, const experiment::Table&) -> scorecard::Judgement {
    throw std::logic_error("No sheet judges this table.");
  };
  return scorecard::judge({stem, stem, refuse}, published, published);
}

/// Stems of published tables without a sheet.
std::vector<std::string> left_over(const std::vector<scorecard::Sheet>& sheets,
                                   const std::filesystem::path& published) {
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(published)) {
    const std::string stem = entry.path().stem();
    const bool has_sheet = stem == "claims" ||
                           std::ranges::any_of(sheets, [&](const auto& sheet) { return sheet.stem == stem; });
    if (entry.path().extension() == ".tsv" && !has_sheet) stems.push_back(stem);
  }
  std::ranges::sort(stems);
  return stems;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path published = "paper/published", data = "build/data";
  const auto options = [&](CLI::App& app) {
    experiment::add_folder(app, "--published", published, "Folder of the paper's numbers");
    experiment::add_folder(app, "--data", data, "Folder of the experiments' tables");
  };
  return experiment::run(
      argc, argv, "scorecard", "Compares every number that the paper prints with ours.", options,
      [&](const experiment::Frame& frame) {
        experiment::Table table = frame.table(
            {"source", "row", "quantity", "published", "reproduced", "verdict", "note", "kind", "settings"});
        table.note("settings",
                   "recovered: the run has one that is not printed and was found by printed outcomes");
        std::vector<scorecard::Line> all;
        const auto add = [&](const std::string& title, const std::vector<scorecard::Line>& lines) {
          for (const auto& [source, row, quantity, printed, judgement] : lines)
            table.row(source, row, quantity, printed, judgement.reproduced, name(judgement.verdict),
                      judgement.note, name(scorecard::kind_of(row, quantity)),
                      scorecard::settings_of(judgement));
          fmt::print("{}", scorecard::report(title, lines));
          all.insert(all.end(), lines.begin(), lines.end());
        };
        const auto sheets = scorecard::sheets();
        for (const auto& sheet : sheets)
          add(sheet.title, scorecard::judge(sheet, published, data));
        for (const auto& stem : left_over(sheets, published))
          add(stem, unjudged(stem, published));
        const auto missing = std::ranges::count_if(
            all, [](const auto& line) { return line.judgement.verdict == scorecard::Verdict::missing; });
        experiment::Table ledger =
            frame.table({"source", "key", "claim", "experiment", "test", "ruling", "evidence"});
        const auto claims = scorecard::judge_claims(published, scorecard::Results({data}));
        for (const auto& c : claims)
          ledger.row(c.source, c.key, c.claim, c.experiment, c.test, name(c.finding.ruling),
                     c.finding.evidence);
        fmt::print("{}", scorecard::report(claims));
        const auto unruled = std::ranges::count_if(
            claims, [](const auto& claim) { return claim.finding.ruling == scorecard::Ruling::missing; });
        experiment::Table verdicts({"source", "row", "quantity", "verdict", "settings"});
        for (const auto& line : all)
          verdicts.row(line.source, line.row, line.quantity, name(line.judgement.verdict),
                       scorecard::settings_of(line.judgement));
        for (const auto& c : claims)
          verdicts.row("text", c.key, "claim", name(c.finding.ruling), "");
        verdicts.write(frame.output / "scorecard_verdicts.tsv");
        frame.write(ledger, "claims");
        frame.write(table);
        const auto all_of = [&](const char* what, scorecard::Kind kind) {
          return scorecard::summary(what, scorecard::shares(scorecard::of_kind(table, kind), "verdict"));
        };
        fmt::print("\nAll outcomes - {}\n{} of the exact ones follow from printed settings alone.\n"
                   "All inputs - {}\nAll seconds - {}\nAll claims - {}\n",
                   all_of("printed outcomes", scorecard::Kind::outcome), scorecard::predicted(table),
                   all_of("printed inputs", scorecard::Kind::input),
                   all_of("printed seconds", scorecard::Kind::seconds),
                   scorecard::summary("claims of the text", scorecard::shares(ledger, "ruling")));
        if (missing + unruled > 0)
          throw std::runtime_error(
              fmt::format("{} published numbers and {} claims have no data to judge them by; see above.",
                          missing, unruled));
      });
}
