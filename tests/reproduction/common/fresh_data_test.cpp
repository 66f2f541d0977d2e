#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

// Tests read data that `make figures` has made only where this very program wrote them and nobody has touched
// them since: experiments/common/fresh_data.sh.

namespace fs = std::filesystem;

namespace fresh_data_test {

class FreshData : public testing::Test {
 protected:
  const fs::path scratch = fs::temp_directory_path() / ("avi_fresh_data_" + std::to_string(::getpid()));
  const fs::path program = scratch / "orbit", made = scratch / "made", folder = scratch / "folder";

  /// A program that writes two tables and a line for each run.
  void SetUp() override {
    fs::create_directories(made);
    compile("");
    shell("'" + program.string() + "' --output '" + made.string() + "'");
    shell(script + "--note '" + program.string() + "' '" + made.string() + "'");
  }
  void TearDown() override { fs::remove_all(scratch); }

  void compile(const std::string& change) const {
    std::ofstream(program)
        << "#!/bin/sh\necho run >>'" << (scratch / "runs").string()
        << "'\nprintf 'q\\n1\\n' >\"$2/orbit.tsv\"\nprintf 'p\\n2\\n' >\"$2/orbit_curve.tsv\"\n"
        << change;
    fs::permissions(program, fs::perms::owner_all);
  }
  static std::string slurp(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void shell(const std::string& command) { EXPECT_EQ(std::system(command.c_str()), 0) << command; }

  /// How often the program runs when a test asks for its data; they are whole then, whoever wrote them.
  long runs() const {
    fs::remove(scratch / "runs");
    shell(script + "'" + program.string() + "' '" + made.string() + "' '" + folder.string() + "'");
    EXPECT_EQ(slurp(folder / "orbit.tsv"), "q\n1\n");
    EXPECT_EQ(slurp(folder / "orbit_curve.tsv"), "p\n2\n");
    return static_cast<long>(slurp(scratch / "runs").size() / 4);
  }

 private:
  const std::string script = "'" AVI_SOURCE_DIR "/experiments/common/fresh_data.sh' ";
};

TEST_F(FreshData, AreCopiedAsLongAsNothingHasChanged) {
  EXPECT_EQ(runs(), 0);
  EXPECT_EQ(runs(), 0);
}

TEST_F(FreshData, OfAnotherProgramAreMadeAgain) {
  compile("# changed\n");
  EXPECT_EQ(runs(), 1);
}

TEST_F(FreshData, ThatWereChangedAreMadeAgain) {
  std::ofstream(made / "orbit_curve.tsv") << "p\n3\n";
  EXPECT_EQ(runs(), 1);
}

TEST_F(FreshData, ThatAreMissingAreMade) {
  fs::remove(made / "orbit.tsv");
  EXPECT_EQ(runs(), 1);
  fs::remove_all(made);
  EXPECT_EQ(runs(), 1);
}

TEST_F(FreshData, LeaveNothingOldBehind) {
  fs::create_directories(folder);
  std::ofstream(folder / "orbit_old.tsv") << "p\n3\n";
  EXPECT_EQ(runs(), 0);
  EXPECT_FALSE(fs::exists(folder / "orbit_old.tsv"));
}

}  // namespace fresh_data_test
