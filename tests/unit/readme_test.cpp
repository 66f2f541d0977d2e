#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The README shows a program whole, with what it prints: the very file that is compiled, and the output that
// the test example/kepler compares.
TEST(Readme, ShowsTheKeplerExampleAsItIs) {
  const fs::path source = AVI_SOURCE_DIR;
  const std::string readme = text_of(source / "README.md");
  const std::string program = text_of(source / "lib/examples/kepler.cpp");
  const std::string output = text_of(source / "lib/examples/kepler.out");
  ASSERT_FALSE(program.empty() || output.empty());
  EXPECT_NE(readme.find("```cpp\n" + program + "```\n"), std::string::npos)
      << "the README shows another program than lib/examples/kepler.cpp";
  EXPECT_NE(readme.find("```\n" + output + "```\n"), std::string::npos)
      << "the README shows another output than lib/examples/kepler.out";
}

TEST(Readme, NamesEveryExample) {
  const fs::path source = AVI_SOURCE_DIR;
  const std::string readme = text_of(source / "README.md");
  int programs = 0;
  for (const auto& entry : fs::directory_iterator(source / "lib/examples")) {
    if (entry.path().extension() != ".cpp") continue;
    ++programs;
    EXPECT_NE(readme.find("`" + entry.path().stem().string() + "`"), std::string::npos) << entry.path();
  }
  EXPECT_GE(programs, 5);
}

}  // namespace
