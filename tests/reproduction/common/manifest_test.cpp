#include "common/table.hpp"
#include "scratch.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

// Two runs on one machine write the same data, seconds aside: the content checksums of
// experiments/common/manifest.sh.

namespace fs = std::filesystem;

namespace manifest_test {

/// Content checksums of a folder's files.
std::map<std::string, std::string> contents(const fs::path& folder) {
  const Scratch scratch;
  const fs::path file = scratch / "manifest.tsv";
  const std::string command = "'" AVI_SOURCE_DIR "/experiments/common/manifest.sh' '" + folder.string() +
                              "' >'" + file.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const experiment::Table manifest = experiment::Table::read(file);
  std::map<std::string, std::string> sums;
  for (std::size_t i = 0; i < manifest.rows.size(); ++i)
    sums[manifest.text(i, "file")] = manifest.text(i, "content");
  return sums;
}

TEST(Manifest, TwoRunsAgree) {
  const Scratch scratch;
  for (const char* folder : {"one", "two"}) {
    fs::create_directories(scratch / folder);
    for (const char* stem : {"p_dependence", "euler_b_errors"}) {
      const std::string command = "'" AVI_BIN_DIR "/" + std::string(stem) + "' --quick --output '" +
                                  (scratch / folder).string() + "'";
      ASSERT_EQ(std::system(command.c_str()), 0) << command;
    }
  }
  auto one = contents(scratch / "one");
  EXPECT_EQ(one.size(), 4u);
  for (const auto& [file, sum] : one)
    EXPECT_EQ(sum.size(), 64u) << file;
  EXPECT_EQ(one, contents(scratch / "two"));

  // The control: seconds do not count, another digit does.
  const fs::path file = scratch / "two" / "p_dependence.tsv";
  experiment::Table table = experiment::Table::read(file);
  table.rows[0][table.column("seconds")] = "99";
  table.write(file);
  EXPECT_EQ(one, contents(scratch / "two"));
  table.rows[0][table.column("iterations")] += "0";
  table.write(file);
  const auto changed = contents(scratch / "two");
  EXPECT_NE(one.at("p_dependence"), changed.at("p_dependence"));
  EXPECT_EQ(one.at("euler_b_errors"), changed.at("euler_b_errors"));
}

}  // namespace manifest_test
