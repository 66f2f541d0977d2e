#include "common/frame.hpp"
#include "generate/pages.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

/// @file
/// Takes today's numbers over into README and the pages of lib/docs, from which both are read.

namespace fs = std::filesystem;

int main(int argc, char** argv) {
  fs::path source = ".", data = "build/data";
  const std::vector<experiment::Option> options{{"--source", &source, "Folder of README.md and lib/docs"},
                                                {"--data", &data, "Folder of the experiments' tables"}};
  return experiment::run(
      argc, argv, "Takes numbers over into the pages.", options, [&](const experiment::Frame&) {
        const auto texts = paper::plain_numbers(scorecard::Results({data}),
                                                experiment::Table::read(source / "lib/docs/numbers.tsv"));
        std::vector<fs::path> pages{source / "README.md"};
        for (const auto& entry : fs::recursive_directory_iterator(source / "lib/docs"))
          if (entry.path().extension() == ".md") pages.push_back(entry.path());
        for (const auto& path : pages) {
          std::ifstream file(path, std::ios::binary);
          const std::string before{std::istreambuf_iterator<char>(file), {}};
          const std::string after = paper::with_numbers(before, texts);
          if (after == before) continue;
          std::ofstream out(path, std::ios::binary);
          out << after;
          out.close();
          if (!out) throw experiment::FileError("Cannot write '" + path.string() + "'.");
          fmt::print("{}\n", path.string());
        }
      });
}
