#include "avi/version.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

// One version, in every place that states it.

namespace {

std::string text_of(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(AVI_SOURCE_DIR "/" + name).rdbuf();
  return text.str();
}

TEST(Version, IsTheSameEverywhere) {
  const std::string version = std::to_string(AVI_VERSION_MAJOR) + '.' + std::to_string(AVI_VERSION_MINOR) +
                              '.' + std::to_string(AVI_VERSION_PATCH);
  EXPECT_NE(text_of("CMakeLists.txt").find("project(avi VERSION " + version + " "), std::string::npos);
  EXPECT_NE(text_of("CITATION.cff").find("\nversion: " + version + "\n"), std::string::npos);
  // The newest entry comes first.
  const std::string changes = text_of("CHANGELOG.md");
  const std::string heading = "\n## " + version;
  EXPECT_EQ(changes.find(heading), changes.find("\n## ")) << "CHANGELOG.md does not begin with " << version;
  EXPECT_NE(changes.find(heading), std::string::npos);
}

}  // namespace
