#include "common/table.hpp"
#include "scratch.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

// tests/instructions/compare.sh, with programs that stand for valgrind and the workload.

namespace fs = std::filesystem;

namespace instructions_test {

struct Ran {
  int status;
  std::string said;
};

class Instructions : public testing::Test {
 protected:
  const Scratch folder;

  void script(const char* name, const std::string& body) const {
    std::ofstream(folder / name) << "#!/bin/sh\n" << body << '\n';
    fs::permissions(folder / name, fs::perms::owner_all);
  }

  /// Compares with a stored count of 1000 when valgrind says `collected`.
  Ran compare(const std::string& collected, const std::string& accept = "") const {
    script("valgrind", "echo '==1== Collected : " + collected + "' >&2");
    script(
        "workload",
        "case $1 in --compiler) echo 'GNU 1' ;; --list) echo orbit ;; *) echo must not run; exit 1 ;; esac");
    std::ofstream(folder / "counts.tsv") << "workload\tcompiler\tinstructions\norbit\tOther 2\t7\n"
                                         << "orbit\tGNU 1\t1000\n";
    const std::string at = folder.string() + "/", said = at + "said";
    const int status =
        std::system(("VALGRIND='" + at + "valgrind' '" AVI_SOURCE_DIR "/tests/instructions/compare.sh' '" +
                     at + "workload' '" + at + "counts.tsv' " + accept + " >'" + said + "' 2>&1")
                        .c_str());
    return {status, text_of(said)};
  }
};

TEST_F(Instructions, WarnAboveTenPerCent) {
  EXPECT_EQ(compare("1100").said, "orbit: 1100 instructions, +10.0 %\n");
  EXPECT_EQ(compare("1111").said, "WARNING: orbit: 1111 instructions, +11.1 %\n");
  EXPECT_EQ(compare("800").said, "orbit: 800 instructions, -20.0 %\n");
  EXPECT_EQ(compare("1111").status, 0);
}

TEST_F(Instructions, ThatCannotBeCountedAreAnError) {
  const Ran ran = compare("none");
  EXPECT_NE(ran.status, 0);
  EXPECT_EQ(ran.said, "The instructions of 'orbit' cannot be counted.\n");
}

TEST_F(Instructions, AreTakenOverForTheirCompilerOnly) {
  compare("2000");
  EXPECT_EQ(experiment::Table::read(folder / "counts.tsv").text(1, "instructions"), "1000");
  compare("2000", "accept");
  const experiment::Table counts = experiment::Table::read(folder / "counts.tsv");
  ASSERT_EQ(counts.rows.size(), 2u);
  EXPECT_EQ(counts.text(0, "instructions"), "7");
  EXPECT_EQ(counts.text(1, "instructions"), "2000");
}

TEST_F(Instructions, OfEveryWorkloadAreKept) {
  const experiment::Table counts =
      experiment::Table::read(fs::path(AVI_SOURCE_DIR) / "tests/instructions/counts.tsv");
  ASSERT_GE(counts.rows.size(), 2u);
  for (std::size_t i = 0; i < counts.rows.size(); ++i) {
    EXPECT_GE(counts.number(i, "instructions"), 1e7) << counts.text(i, "workload");
    EXPECT_LE(counts.number(i, "instructions"), 1e8) << counts.text(i, "workload");
  }
}

}  // namespace instructions_test
