#include "common/table.hpp"
#include "scratch.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

/// An experiment meets a user who mistypes: status 2, one sentence on stderr, no file left.

namespace fs = std::filesystem;

namespace front_door_test {

struct Answer {
  int status = -1;
  std::string out, err;
};

class FrontDoor : public testing::TestWithParam<std::string> {
 protected:
  const Scratch scratch;
  const fs::path output = scratch / "output";

  void SetUp() override { fs::create_directory(output); }

  /// Runs the experiment. What is not refused runs its course, and its status is not 2.
  [[nodiscard]] Answer run(const std::string& arguments) const {
    const std::string command = "'" AVI_BIN_DIR "/" + GetParam() + "' " + arguments + " >'" +
                                (scratch / "out").string() + "' 2>'" + (scratch / "err").string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(scratch / "out"), text_of(scratch / "err")};
  }

  void expect_refused(const std::string& arguments) const {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.status, 2) << GetParam() << ' ' << arguments << '\n' << answer.err;
    EXPECT_TRUE(answer.err.starts_with(GetParam() + ": ")) << answer.err;
    EXPECT_TRUE(answer.err.ends_with(".\n")) << answer.err;
    EXPECT_EQ(std::count(answer.err.begin(), answer.err.end(), '\n'), 1) << answer.err;
    EXPECT_EQ(answer.out, "") << GetParam() << ' ' << arguments;
    EXPECT_TRUE(fs::is_empty(output)) << GetParam() << ' ' << arguments << " left a file";
  }

  [[nodiscard]] std::string quick() const { return "--quick --output '" + output.string() + "' "; }
};

TEST_P(FrontDoor, Helps) {
  const Answer answer = run("--help");
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.err, "");
  for (const char* text : {"Usage:", "--output", "--quick"})
    EXPECT_NE(answer.out.find(text), std::string::npos) << text;
}

TEST_P(FrontDoor, RefusesUnknownOptionsAndArguments) {
  for (const char* arguments : {"--nonsense", "stray", "--quick=maybe", "-z"})
    expect_refused(quick() + arguments);
  EXPECT_NE(run("--nonsense").err.find(": --nonsense. Run with --help"), std::string::npos);
  expect_refused("--output");
}

/// Else `make` would take its data for those of the whole run.
TEST_P(FrontDoor, PutsAShortenedRunIntoAFolderOfItsOwn) {
  if (GetParam() == "scorecard") return;  // It has no data there.
  const std::string command =
      "cd '" + scratch.string() + "' && '" AVI_BIN_DIR "/" + GetParam() + "' --quick >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(fs::exists(scratch / "build/quick" / (GetParam() + ".tsv")));
  EXPECT_FALSE(fs::exists(scratch / "build/data"));
}

TEST(DataFiles, TellWhatMadeThem) {
  const Scratch scratch;
  const std::string command = "'" AVI_BIN_DIR "/euler_b_errors' --quick --output '" + scratch.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string file = text_of(scratch / "euler_b_errors.tsv");
  for (const char* note : {"commit: ", "compiler: ", "flags: ", "libraries: Eigen ", "machine: ", "date: "})
    EXPECT_NE(file.find(std::string("\n# ") + note), std::string::npos) << note;
}

TEST_P(FrontDoor, RefusesAFolderItCannotWrite) {
  expect_refused("--quick --output /dev/null/nowhere");
  std::ofstream(scratch / "file") << "no folder";
  expect_refused("--quick --output '" + (scratch / "file").string() + "'");
  if (::geteuid() == 0) return;  // Root may write anywhere.
  fs::permissions(output, fs::perms::owner_read | fs::perms::owner_exec);
  expect_refused(quick());
  fs::permissions(output, fs::perms::owner_all);
}

/// --help names every option with the kind of its value.
TEST_P(FrontDoor, RefusesFoldersThatDoNotExist) {
  static const std::regex option(R"((--[a-z0-9-]+) DIR)");
  const std::string help = run("--help").out;
  for (auto match = std::sregex_iterator(help.begin(), help.end(), option); match != std::sregex_iterator();
       ++match)
    expect_refused(quick() + (*match)[1].str() + " /dev/null/nowhere");
}

class Scorecard : public testing::Test {
 protected:
  const Scratch scratch;

  void SetUp() override { fs::create_directory(scratch / "empty"); }

  /// Judges these published tables without any data; its status.
  [[nodiscard]] int status_of(const fs::path& published) const {
    const std::string command = "'" AVI_BIN_DIR "/scorecard' --published '" + published.string() +
                                "' --data '" + (scratch / "empty").string() + "' --output '" +
                                scratch.string() + "' >'" + (scratch / "out").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

/// A published number without data is a row of the scorecard and a status, never silence.
TEST_F(Scorecard, FailsWhereDataAreMissing) {
  EXPECT_EQ(status_of(AVI_PUBLISHED_DIR), 1);
  const experiment::Table card = experiment::Table::read(scratch / "scorecard.tsv");
  EXPECT_GT(card.rows.size(), 200u);
  for (std::size_t i = 0; i < card.rows.size(); ++i)
    EXPECT_EQ(card.text(i, "verdict"), "missing");
  EXPECT_NE(text_of(scratch / "out").find("kepler_e090.tsv"), std::string::npos);
}

/// So is a published table that no sheet judges.
TEST_F(Scorecard, FailsWhereATableHasNoSheet) {
  fs::copy(AVI_PUBLISHED_DIR, scratch / "published");
  std::ofstream(scratch / "published" / "table7.tsv") << "source\trow\n";
  EXPECT_EQ(status_of(scratch / "published"), 1);
  EXPECT_NE(text_of(scratch / "out").find("table7.tsv"), std::string::npos) << text_of(scratch / "out");
}

// What they say is that of one frame: programs with options of every kind, and one without.
INSTANTIATE_TEST_SUITE_P(Experiments, FrontDoor,
                         testing::Values("scorecard", "long_horizon", "euler_b_errors"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace front_door_test
