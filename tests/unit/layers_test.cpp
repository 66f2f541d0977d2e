#include "text_of.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace layers_test {

const fs::path source = AVI_SOURCE_DIR;

/// A folder of lib/avi may include its own files and those of lower floors: nothing sideways, nothing
/// upwards.
const std::map<std::string, int> floors{
    {"core", 0},  {"autodiff", 1},    {"transform", 2}, {"integrators", 2}, {"problems", 2},
    {"optim", 2}, {"diagnostics", 2}, {"htvi", 3},      {"collocation", 3}, {"bregman", 3}};

bool may_include(const std::string& from, const std::string& to) {
  return from == to || floors.at(from) > floors.at(to);
}

std::vector<std::string> lines_of(const fs::path& path) { return ::lines_of(text_of(path)); }

std::vector<fs::path> files_under(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
      files.push_back(entry.path());
  return files;
}

/// Quoted includes of a file.
std::vector<std::string> includes_of(const fs::path& path) {
  static const std::regex quoted("^#include \"([^\"]+)\"");
  std::vector<std::string> includes;
  std::smatch match;
  for (const std::string& line : lines_of(path))
    if (std::regex_search(line, match, quoted)) includes.push_back(match[1]);
  return includes;
}

TEST(Layers, AllowOnlyWhatLiesBelow) {
  EXPECT_TRUE(may_include("htvi", "autodiff"));
  EXPECT_FALSE(may_include("autodiff", "htvi"));
  EXPECT_FALSE(may_include("autodiff", "problems"));
}

TEST(Layers, LibraryIncludesPointDown) {
  int seen = 0;
  for (const fs::path& file : files_under(source / "lib/avi")) {
    const std::string folder = *fs::relative(file, source / "lib/avi").begin();
    if (folder.ends_with(".hpp")) continue;  // what stands before all folders may use them all
    ASSERT_TRUE(floors.contains(folder)) << "lib/avi/" << folder << " has no floor in this test yet";
    for (const std::string& include : includes_of(file)) {
      ASSERT_TRUE(include.starts_with("avi/"))
          << file << " includes " << include << ", which is not the library's";
      const std::string target = *std::next(fs::path(include).begin());
      ASSERT_TRUE(floors.contains(target)) << file << " includes " << include;
      EXPECT_TRUE(may_include(folder, target)) << file << " includes " << include;
      ++seen;
    }
  }
  EXPECT_GT(seen, 10);
}

TEST(Layers, OneHeaderBringsTheWholeLibrary) {
  std::vector<std::string> brought{"avi/avi.hpp"};
  std::set<std::string> known(brought.begin(), brought.end());
  for (std::size_t i = 0; i < brought.size(); ++i)
    for (const std::string& include : includes_of(source / "lib" / brought[i]))
      if (known.insert(include).second) brought.push_back(include);
  for (const fs::path& file : files_under(source / "lib/avi"))
    EXPECT_TRUE(known.contains(fs::relative(file, source / "lib").string()))
        << "avi/avi.hpp does not bring " << file;
}

TEST(Layers, ExperimentsUseNoTests) {
  for (const fs::path& file : files_under(source / "experiments"))
    for (const std::string& include : includes_of(file))
      EXPECT_TRUE(include.starts_with("avi/") || fs::exists(source / "experiments" / include))
          << file << " includes " << include;
}

// Several are compiled as one file: what one of them names, another one must not come to rely on.
TEST(Layers, TestsHaveNamespacesOfTheirOwn) {
  for (const char* folder : {"unit", "property", "stability"})
    for (const auto& entry : fs::directory_iterator(source / "tests" / folder)) {
      const std::string stem = entry.path().stem().string();
      if (!stem.ends_with("_test")) continue;
      int own = 0;
      for (const std::string& line : lines_of(entry.path())) {
        own += line == "namespace " + stem + " {";
        EXPECT_NE(line, "namespace {") << entry.path();
      }
      EXPECT_EQ(own, 1) << entry.path();
    }
}

TEST(Layers, FilesStayShort) {
  for (const char* folder : {"lib", "experiments", "paper", "tests"})
    for (const fs::path& file : files_under(source / folder))
      EXPECT_LE(lines_of(file).size(), 500u) << file << " is no longer one idea";
}

/// What lies in figures/<chapter> is drawn by an experiment's name, or loaded by such a script.
TEST(Layers, EveryFigureHasAnExperiment) {
  std::set<std::string> drawn;
  std::string scripts;
  for (const std::string& line : lines_of(AVI_BUILD_DIR "/experiments.tsv")) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i < 4; ++i)
      std::getline(cells, cell, '\t');
    if (!fs::exists(source / cell)) continue;
    drawn.insert(cell);
    for (const std::string& code : lines_of(source / cell))
      scripts += code + '\n';
  }
  EXPECT_GT(drawn.size(), 25u);
  for (const auto& entry : fs::recursive_directory_iterator(source / "figures")) {
    if (entry.path().extension() != ".gp") continue;
    const std::string script = fs::relative(entry.path(), source).string();
    EXPECT_TRUE(drawn.contains(script) || scripts.find("load '" + script + "'") != std::string::npos)
        << script;
  }
}

}  // namespace layers_test
