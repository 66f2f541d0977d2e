#include "common/frame.hpp"
#include "common/table.hpp"
#include "scratch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <poll.h>
#include <string>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

// Experiments on a disk that is full, interrupted while they run, and two in one folder: whatever happens,
// each file that is there is whole.

namespace fs = std::filesystem;

namespace disk_and_interrupt_test {

constexpr rlim_t no_limit = RLIM_INFINITY;

/// A running experiment, its stderr in a pipe.
class Process {
 public:
  Process(const std::string& stem, const std::vector<std::string>& arguments,
          rlim_t largest_file = no_limit) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) ADD_FAILURE() << "no pipe";
    id_ = ::fork();
    if (id_ == 0) {
      std::signal(SIGINT, SIG_DFL);  // a shell's background job ignores it
      ::dup2(ends[1], STDERR_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      const rlimit limit{largest_file, largest_file};
      if (largest_file != no_limit) ::setrlimit(RLIMIT_FSIZE, &limit);
      const std::string program = std::string(AVI_BIN_DIR "/") + stem;
      std::vector<char*> argv{const_cast<char*>(program.c_str())};
      for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
      argv.push_back(nullptr);
      ::execv(program.c_str(), argv.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() { ::close(pipe_); }

  void interrupt() const { ::kill(id_, SIGINT); }

  /// Waits for its end: the exit status, or minus the signal that ended it.
  int wait() {
    for (char letter; ::read(pipe_, &letter, 1) == 1;)
      err += letter;
    int status = 0;
    ::waitpid(id_, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  }

  std::string err;

 private:
  pid_t id_ = 0;
  int pipe_ = 0;
};

class Disk : public testing::Test {
 protected:
  const Scratch output;

  [[nodiscard]] std::vector<std::string> quick() const { return {"--quick", "--output", output.string()}; }

  /// Number of files; each must be a whole table.
  [[nodiscard]] int whole_files() const {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(output)) {
      ++files;
      EXPECT_EQ(entry.path().extension(), ".tsv") << entry.path() << " was left behind";
      EXPECT_NO_THROW((void)experiment::Table::read(entry.path())) << entry.path() << " is no whole table";
    }
    return files;
  }
};

TEST_F(Disk, FullFromTheStartIsRefusedByEveryExperiment) {
  const auto experiments = experiment::Table::read(AVI_BUILD_DIR "/experiments.tsv");
  for (std::size_t i = 0; i < experiments.rows.size(); ++i) {
    const std::string stem = experiments.text(i, "name");
    Process process(stem, quick(), 0);
    EXPECT_EQ(process.wait(), 2) << stem;
    EXPECT_EQ(process.err, stem + ": Output folder '" + output.string() +
                               "' cannot be written; name one that can with --output DIR.\n");
    EXPECT_EQ(whole_files(), 0) << stem;
  }
  EXPECT_GE(experiments.rows.size(), 18u);
}

TEST_F(Disk, FullAtTheEndLeavesNoHalfTable) {
  Process process("bregman_extremes", quick(),
                  12'000);  // the table of overflows fits, the main table does not
  EXPECT_EQ(process.wait(), 2);
  EXPECT_EQ(process.err, "bregman_extremes: Cannot write '" + (output / "bregman_extremes.tsv").string() +
                             "': File too large.\n");
  EXPECT_EQ(whole_files(), 2);
}

TEST_F(Disk, AnInterruptLeavesNoHalfTable) {
  for (const int milliseconds : {5, 50, 200, 800}) {
    Process process("bregman_extremes", {"--output", output.string()});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    process.interrupt();
    EXPECT_EQ(process.wait(), -SIGINT);
    EXPECT_LE(whole_files(), 3);
    EXPECT_FALSE(fs::exists(output / "bregman_extremes.tsv"));
  }
}

constexpr std::size_t rows = 100'000;

/// A table that takes a while to write.
experiment::Table large_table() {
  experiment::Table table({"row", "third"});
  for (std::size_t i = 0; i < rows; ++i)
    table.row(i, 1.0 / 3.0);
  return table;
}

/// A child that writes it as large.tsv and ends with status 0, or waits for a signal where it is to stay.
pid_t writer(const experiment::Table& table, const fs::path& output, bool stays) {
  const pid_t id = ::fork();
  if (id != 0) return id;
  std::signal(SIGINT, SIG_DFL);
  try {
    experiment::Frame{.name = "large", .output = output}.write(table);
  } catch (const std::exception&) {
    ::_exit(1);
  }
  if (stays) ::pause();
  ::_exit(0);
}

TEST_F(Disk, AnInterruptDuringTheWritingOfATableWaitsForItsEnd) {
  const experiment::Table table = large_table();
  const int watch = ::inotify_init();
  ASSERT_GE(::inotify_add_watch(watch, output.c_str(), IN_CREATE), 0);
  const pid_t child = writer(table, output, true);
  pollfd created{.fd = watch, .events = POLLIN, .revents = 0};
  EXPECT_EQ(::poll(&created, 1, 60'000), 1);  // the temporary file is there, and not yet full
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(watch);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  ASSERT_EQ(whole_files(), 1);
  EXPECT_EQ(experiment::Table::read(output / "large.tsv").rows.size(), rows);
}

TEST_F(Disk, TwoThatWriteOneTableAtATimeLeaveItWhole) {
  const experiment::Table table = large_table();
  for (const pid_t child : {writer(table, output, false), writer(table, output, false)}) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  ASSERT_EQ(whole_files(), 1);
  EXPECT_EQ(experiment::Table::read(output / "large.tsv").rows.size(), rows);
}

TEST_F(Disk, TwoRunsInOneFolderLeaveWholeTables) {
  Process first("euler_b_errors", quick()), second("euler_b_errors", quick());
  EXPECT_EQ(first.wait(), 0) << first.err;
  EXPECT_EQ(second.wait(), 0) << second.err;
  const int files = whole_files();
  Process alone("euler_b_errors", quick());
  EXPECT_EQ(alone.wait(), 0);
  EXPECT_EQ(whole_files(), files);
  EXPECT_GE(files, 1);
}

}  // namespace disk_and_interrupt_test
