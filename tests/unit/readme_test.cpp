#include "text_of.hpp"

#include <gtest/gtest.h>

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

TEST(Examples, AreAllOnTheirPage) {
  const std::string readme = text_of(source / "lib/docs/examples.md");
  int programs = 0;
  for (const auto& entry : fs::directory_iterator(source / "lib/examples")) {
    if (entry.path().extension() != ".cpp") continue;
    ++programs;
    EXPECT_NE(readme.find("\n## [" + entry.path().stem().string() + "]("), std::string::npos) << entry.path();
  }
  EXPECT_GE(programs, 5);
}

}  // namespace readme_test
