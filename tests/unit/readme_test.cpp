#include "text_of.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace fs = std::filesystem;

namespace readme_test {

const fs::path source = AVI_SOURCE_DIR;

// The README shows a program whole, with what it prints: the very file that is compiled, and the output that
// the test example/orbit compares.
TEST(Readme, ShowsTheOrbitExampleAsItIs) {
  const std::string readme = text_of(source / "README.md");
  const std::string program = text_of(source / "lib/examples/orbit.cpp");
  const std::string output = text_of(source / "lib/examples/orbit.out");
  ASSERT_FALSE(program.empty() || output.empty());
  EXPECT_NE(readme.find("```cpp\n" + program + "```\n"), std::string::npos)
      << "the README shows another program than lib/examples/orbit.cpp";
  EXPECT_NE(readme.find("```\n" + output + "```\n"), std::string::npos)
      << "the README shows another output than lib/examples/orbit.out";
}

TEST(Readme, NamesEveryExample) {
  const std::string readme = text_of(source / "README.md");
  int programs = 0;
  for (const auto& entry : fs::directory_iterator(source / "lib/examples")) {
    if (entry.path().extension() != ".cpp") continue;
    ++programs;
    EXPECT_NE(readme.find("`" + entry.path().stem().string() + "`"), std::string::npos) << entry.path();
  }
  EXPECT_GE(programs, 5);
}

// What the pages of the reference documentation name exists in the library.
TEST(Docs, NameWhatExists) {
  std::set<std::string> words;
  const std::regex word("[A-Za-z_][A-Za-z_0-9]*"), name("avi::([A-Za-z_][A-Za-z_0-9]*)");
  for (const auto& entry : fs::recursive_directory_iterator(source / "lib/avi")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator i(text.begin(), text.end(), word), end; i != end; ++i)
      words.insert(i->str());
  }
  int names = 0;
  for (const char* page : {"mainpage.md", "monitors.md", "methods.md", "problems.md", "errors.md"}) {
    const std::string text = text_of(source / "lib/docs" / page);
    for (std::sregex_iterator i(text.begin(), text.end(), name), end; i != end; ++i, ++names)
      EXPECT_TRUE(words.contains((*i)[1])) << page << " names " << i->str();
  }
  EXPECT_GT(names, 30);
}

}  // namespace readme_test
