#include "common/frame.hpp"
#include "generate/numbers.hpp"
#include "generate/tables.hpp"

#include <fstream>
#include <set>
#include <stdexcept>

/// @file
/// Every number and table of the paper from the data: numbers.tex and tables/<name>.tex.

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("Cannot write '" + path.string() + "'.");
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path source = "paper", data = "build/data";
  const std::vector<experiment::Option> options{
      {"--paper", &source, "Folder of numbers.tsv, tables.tsv and published/"},
      {"--data", &data, "Folder of the experiments' tables"}};
  return experiment::run(
      argc, argv, "Makes the paper's numbers and tables.", options, [&](const experiment::Frame& frame) {
        const auto tables = frame.output / "tables";
        std::filesystem::create_directories(tables);
        const scorecard::Results results({data});
        const auto numbers = experiment::Table::read(source / "numbers.tsv");
        paper::refuse_drift(results("work_precision_advice"));
        paper::check_senses(results, numbers, experiment::Table::read(source / "senses.tsv"));
        const experiment::Table &card = results("scorecard"), &claims = results("scorecard_claims");
        const auto published = [&](const char* stem) {
          return experiment::Table::read(source / "published" / (std::string(stem) + ".tsv"));
        };
        for (const char* stem : {"kepler_e090", "kepler_e099"})
          write(tables / (std::string(stem) + ".tex"), paper::published_table(published(stem), card));
        for (const char* stem : {"direct_vs_adaptive", "method_comparison", "p_dependence"})
          write(tables / (std::string(stem) + ".tex"), paper::iteration_table(published(stem), card));
        write(tables / "optimiser_comparison.tex",
              paper::optimiser_table(published("optimiser_comparison"), card));
        write(tables / "notes.tex", paper::notes_table(card));
        write(tables / "claims.tex", paper::claims_table(claims));
        write(tables / "shares.tex", paper::shares_table(card, claims));
        const experiment::Table list = experiment::Table::read(source / "tables.tsv");
        std::set<std::string> names;
        for (const auto& column : scorecard::rows(list))
          names.insert(column.text("table"));
        for (const auto& name : names)
          write(tables / (name + ".tex"), paper::declared_table(results, list, name));
        write(frame.output / "numbers.tex", paper::numbers_tex(results, numbers));
      });
}
