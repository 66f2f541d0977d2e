#include "avi/version.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <string>

// One version, in every place that states it.

namespace version_test {

TEST(Version, IsTheSameEverywhere) {
  const std::string version = std::to_string(AVI_VERSION_MAJOR) + '.' + std::to_string(AVI_VERSION_MINOR) +
                              '.' + std::to_string(AVI_VERSION_PATCH);
  EXPECT_EQ(avi::version(), version) << "the library is older than its headers";
  EXPECT_NE(text_of(AVI_SOURCE_DIR "/CMakeLists.txt").find("project(avi VERSION " + version + " "),
            std::string::npos);
  EXPECT_NE(text_of(AVI_SOURCE_DIR "/CITATION.cff").find("\nversion: " + version + "\n"), std::string::npos);
  // The newest entry comes first.
  const std::string changes = text_of(AVI_SOURCE_DIR "/CHANGELOG.md");
  const std::string heading = "\n## " + version;
  EXPECT_EQ(changes.find(heading), changes.find("\n## ")) << "CHANGELOG.md does not begin with " << version;
  EXPECT_NE(changes.find(heading), std::string::npos);
}

}  // namespace version_test
