#include "avi/core/outcome.hpp"
#include "generate/pages.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

// README and the pages of the documentation say what is so: their programs are files that are compiled and
// whose output is compared, their names exist, their numbers come from data, their links lead somewhere.

namespace fs = std::filesystem;

namespace guide_test {

const fs::path source = AVI_SOURCE_DIR, docs = source / "lib/docs";

std::vector<fs::path> pages_in(const fs::path& folder) {
  std::vector<fs::path> pages;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}
std::vector<fs::path> guide() { return pages_in(docs); }
std::vector<fs::path> all_pages() {
  std::vector<fs::path> pages = guide();
  for (const auto& folder : {docs / "notes", docs / "chapters"})
    for (const auto& page : pages_in(folder))
      pages.push_back(page);
  pages.push_back(source / "README.md");
  return pages;
}

/// A block of code: its language, the file that the comment above it names, and its lines.
struct Block {
  std::string language, file, text;
};

/// The blocks of a page, and what is left of it without them.
std::pair<std::vector<Block>, std::string> taken_apart(const std::string& page) {
  std::vector<Block> blocks;
  std::string prose, before;
  bool inside = false;
  for (const auto& line : lines_of(page)) {
    if (line.starts_with("```")) {
      inside = !inside;
      std::smatch match;
      if (inside)
        blocks.push_back(
            {line.substr(3),
             std::regex_match(before, match, std::regex("<!-- ([\\w/.]+) -->")) ? match.str(1) : "", ""});
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else {
      prose += line + "\n";
    }
    before = line;
  }
  EXPECT_FALSE(inside) << "a block of code has no end";
  return {blocks, prose};
}

/// Without the spaces that all its lines begin with.
std::string unindented(const std::string& text) {
  std::size_t common = std::string::npos;
  for (const auto& line : lines_of(text))
    if (!line.empty()) common = std::min(common, line.find_first_not_of(' '));
  std::string out;
  for (const auto& line : lines_of(text))
    out += (line.empty() ? line : line.substr(common)) + "\n";
  return out;
}

bool contains(const std::string& file, const std::string& block) {
  if (file.find(block) != std::string::npos) return true;
  // A part that stands further right in the file.
  const auto part = lines_of(unindented(block)), whole = lines_of(file);
  for (std::size_t at = 0; at + part.size() <= whole.size(); ++at) {
    std::string there;
    for (std::size_t i = 0; i < part.size(); ++i)
      there += whole[at + i] + "\n";
    if (unindented(there) == unindented(block)) return true;
  }
  return false;
}

TEST(Pages, ShowProgramsThatAreCompiledAndOutputThatIsCompared) {
  int programs = 0, outputs = 0;
  for (const auto& page : all_pages())
    for (const auto& block : taken_apart(text_of(page)).first) {
      if (block.file.empty()) {
        EXPECT_TRUE(
            block.language == "sh" || block.language == "cmake" || block.language == "text" ||
            (block.language == "python" && !text_of(source / "lib/python/tests/docs_test.py").empty()))
            << page << " shows a program of no file:\n"
            << block.text;
        continue;
      }
      ASSERT_TRUE(fs::exists(source / block.file)) << page << ": " << block.file;
      EXPECT_TRUE(contains(text_of(source / block.file), block.text))
          << page << " shows what is not in " << block.file << ":\n"
          << block.text;
      ++(block.language.empty() ? outputs : programs);
    }
  EXPECT_GE(programs, 5);
  EXPECT_GE(outputs, 3);
}

/// A program that is copied compiles with other standard libraries, too.
TEST(Examples, IncludeTheHeadersOfWhatTheyUse) {
  const std::vector<std::pair<std::string, std::string>> homes{
      {"algorithm", "std::(max|min|transform)\\b"},
      {"array", "std::array\\b"},
      {"cmath", "M_PI|std::(abs|cos|exp|floor|hypot|log1p|lround|nan|pow|round|sin|sqrt)\\b"},
      {"cstddef", "std::size_t\\b"},
      {"cstdio", "std::(printf|puts)\\b"},
      {"stdexcept", "std::invalid_argument\\b"},
      {"string", "std::string\\b"},
      {"utility", "std::pair\\b"},
      {"vector", "std::vector\\b"}};
  int used = 0;
  for (const auto& entry : fs::recursive_directory_iterator(source / "lib/examples")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = text_of(entry.path());
    for (const auto& [header, names] : homes) {
      if (!std::regex_search(text, std::regex(names))) continue;
      EXPECT_NE(text.find("#include <" + header + ">\n"), std::string::npos)
          << entry.path() << ": " << header;
      ++used;
    }
  }
  EXPECT_GE(used, 40);
}

TEST(Pages, NameWhatExists) {
  std::set<std::string> words;
  for (const auto& entry : fs::recursive_directory_iterator(source / "lib/avi")) {
    if (!entry.is_regular_file()) continue;
    const auto its = matches(text_of(entry.path()), "([A-Za-z_][A-Za-z_0-9]*)");
    words.insert(its.begin(), its.end());
  }
  words.insert({"avi", "same_digits"});  // targets of CMake
  int names = 0;
  for (const auto& page : all_pages())
    for (const auto& name : matches(text_of(page), "avi::([A-Za-z_][A-Za-z_0-9]*)")) {
      EXPECT_TRUE(words.contains(name)) << page << " names avi::" << name;
      ++names;
    }
  EXPECT_GT(names, 100);
}

TEST(Pages, LinkToWhatExists) {
  for (const auto& page : all_pages())
    for (const auto& target : matches(taken_apart(text_of(page)).second, "\\]\\(([^)\\s]+)\\)")) {
      const std::string file = target.substr(0, target.find('#'));
      if (target.starts_with("http") || file.empty()) continue;
      EXPECT_TRUE(fs::exists(page.parent_path() / file)) << page << " links to " << target;
    }
}

/// What a person typed as a measured number: a decimal fraction, a power of ten, per cent. Numbers in code,
/// in formulas and between the marks of page_numbers are none.
std::vector<std::string> typed_numbers(const std::string& page) {
  std::string text = taken_apart(page).second;
  for (const char* apart : {"<!--= [\\w.]+ -->[^<]*<!--/-->", "`[^`]+`", "\\$\\$[^$]+\\$\\$", "\\$[^$]+\\$",
                            "\\]\\([^)]*\\)", "https?://\\S+", "Section [0-9.]+"})
    text = std::regex_replace(text, std::regex(apart), " ");
  return matches(text, "(?:^|[^\\w.])(\\d+\\.\\d+(?:e-?\\d+)?|\\d+e-?\\d+|\\d+ %)");
}

TEST(Pages, TypeNoMeasuredNumber) {
  EXPECT_EQ(typed_numbers("takes 0.7 of 3e-5, 20 %, <!--= a -->1.5<!--/--> `1e-6` $0.5$ 16, Section 3.3"),
            (std::vector<std::string>{"0.7", "3e-5", "20 %"}));
  for (const auto& page : all_pages()) {
    // These have numbers of sections and equations, and shares that front_page_test compares.
    const std::string name = page.filename();
    if (name == "paper_to_code.md" || name == "reproduction.md") continue;
    for (const auto& number : typed_numbers(text_of(page)))
      ADD_FAILURE() << page << " has a number of no data: " << number;
  }
}

TEST(Pages, HaveNumbersThatTheListHas) {
  const auto list = experiment::Table::read(docs / "numbers.tsv");
  std::set<std::string> listed, used;
  for (std::size_t i = 0; i < list.rows.size(); ++i)
    listed.insert(list.text(i, "name"));
  for (const auto& page : all_pages())
    for (const auto& [name, text] : paper::numbers_on(text_of(page))) {
      EXPECT_TRUE(listed.contains(name)) << page << ": " << name;
      used.insert(name);
    }
  EXPECT_EQ(used, listed);
}

TEST(Pages, HaveTheNumbersOfTheData) {
  const auto list = experiment::Table::read(docs / "numbers.tsv");
  const auto today = paper::plain_numbers(
      scorecard::Results({fs::path(AVI_CHECK_DIR) / "data", source / "build/data"}), list);
  if (today.empty()) GTEST_SKIP() << "there are no data";
  for (const auto& page : all_pages())
    for (const auto& [name, text] : paper::numbers_on(text_of(page))) {
      const auto found = today.find(name);
      if (found == today.end()) continue;
      const double within = scorecard::find(list, {{"name", name}}).number("within");
      if (within == 1.0) {
        EXPECT_EQ(text, found->second) << page << ", " << name << ": make verdicts takes it over";
      } else {
        const double ratio = std::stod(text) / std::stod(found->second);
        EXPECT_LT(std::max(ratio, 1.0 / ratio), within) << page << ", " << name;
      }
    }
}

TEST(Guide, IsShort) {
  for (const auto& page : guide()) {
    const auto [blocks, prose] = taken_apart(text_of(page));
    std::istringstream stream(prose);
    long count = 0, lines = 0;
    for (std::string word; stream >> word;)
      ++count;
    for (const auto& block : blocks)
      lines += static_cast<long>(lines_of(block.text).size());
    EXPECT_LE(count + 8 * lines, 1300)
        << page << ": " << count << " words, " << lines << " lines of programs";
  }
}

/// The front page lists every page of the guide, the notes' first page every note.
TEST(Guide, ListsEveryPage) {
  for (const auto& folder : {docs, docs / "notes"}) {
    const std::string index = text_of(folder / "README.md");
    for (const auto& page : pages_in(folder))
      if (page.filename() != "README.md") {
        EXPECT_NE(index.find("](" + page.filename().string() + ")"), std::string::npos) << page;
      }
  }
}

TEST(Guide, SaysEveryOutcome) {
  const std::string page = text_of(docs / "when_it_says_no.md");
  for (int i = 0; i <= static_cast<int>(avi::Outcome::time_limit); ++i) {
    const std::string name(avi::name(static_cast<avi::Outcome>(i)));
    EXPECT_NE(page.find("\n| `" + name + "` |"), std::string::npos) << name;
  }
}

/// Every sentence that tests/misuse expects from the compiler is explained, and no other.
TEST(Guide, SaysEverySentenceOfTheCompiler) {
  std::string page = std::regex_replace(text_of(docs / "compiler.md"), std::regex("`"), "");
  std::set<std::string> expected;
  for (const auto& entry : fs::directory_iterator(source / "tests/misuse")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string first = lines_of(text_of(entry.path())).at(0);
    ASSERT_TRUE(first.starts_with("// error: ")) << entry.path();
    const std::string sentence = std::regex_replace(first.substr(10), std::regex("`"), "");
    EXPECT_NE(page.find(sentence), std::string::npos) << entry.path() << ": " << sentence;
    expected.insert(sentence);
  }
  const auto begin = page.find("# What the compiler says");
  ASSERT_NE(begin, std::string::npos);
  for (const auto& line : lines_of(page.substr(begin))) {
    if (!line.starts_with("| ") || line.starts_with("| the compiler says") || line.starts_with("| ---"))
      continue;
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const auto& sentence) {
      return line.substr(2).starts_with(sentence);
    })) << line;
  }
}

/// Designated initialisers have to stand in the order of their declaration.
TEST(Guide, ListsOptionsInTheOrderOfTheirDeclaration) {
  const std::string header = text_of(source / "lib/avi/solve.hpp");
  const auto begin = header.find("struct SolveOptions {");
  ASSERT_NE(begin, std::string::npos);
  const auto declared =
      matches(header.substr(begin, header.find("\n};", begin) - begin), "\n  [\\w:<>&() ]+ (\\w+) = [^;]+;");
  std::string column;
  for (const auto& line : lines_of(text_of(docs / "times_and_events.md")))
    if (line.starts_with("| `")) column += line.substr(0, line.find('|', 1));
  EXPECT_EQ(matches(column, "`(\\w+)`"), declared);
  EXPECT_GE(declared.size(), 12u);
}

/// The map from names to headers: each name is declared in the header beside it.
TEST(Guide, MapsNamesToTheirHeaders) {
  const std::regex row("\\| `avi::([\\w:<>]+)(\\(\\))?`[^|]*\\|[^|]*\\| `<(avi/[\\w/.]+)>` \\|");
  const std::string page = text_of(docs / "interface.md");
  int rows = 0;
  for (std::sregex_iterator i(page.begin(), page.end(), row), end; i != end; ++i, ++rows) {
    const fs::path header = source / "lib" / i->str(3);
    ASSERT_TRUE(fs::exists(header)) << header;
    const std::regex declared("\\b" + i->str(1) + "\\b");
    EXPECT_TRUE(std::regex_search(text_of(header), declared)) << i->str(1) << " is not in " << header;
  }
  EXPECT_GE(rows, 25);
}

}  // namespace guide_test
