#include "fuzz/door.hpp"
#include "fuzz/options.hpp"
#include "fuzz/step.hpp"
#include "fuzz/table.hpp"
#include "scratch.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <vector>

// The corpus of the fuzz targets, and deterministic mutations of it: every compiler runs them, where `make
// fuzz` searches for more.

namespace fs = std::filesystem;

namespace fuzz_replay_test {

using Target = void (*)(const std::uint8_t*, std::size_t);

std::vector<std::string> corpus(const std::string& target) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(AVI_SOURCE_DIR "/tests/fuzz/corpus/" + target))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> inputs;
  for (const fs::path& path : paths)
    inputs.push_back(text_of(path));
  return inputs;
}

/// A few bytes changed, taken out, or put in from another input.
std::string mutated(const std::vector<std::string>& inputs, std::mt19937_64& random) {
  std::string text = inputs[random() % inputs.size()];
  for (std::uint64_t i = random() % 4 + 1; i-- > 0;) {
    const std::size_t at = random() % (text.size() + 1);
    const std::string& other = inputs[random() % inputs.size()];
    switch (random() % 4) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random() % 256);
      break;
    case 1:
      text.erase(at, random() % 9);
      break;
    case 2:
      text.insert(at, 1, static_cast<char>(random() % 256));
      break;
    default:
      if (!other.empty()) text.insert(at, other.substr(random() % other.size(), random() % 17));
    }
  }
  return text;
}

void replay(const std::string& name, Target target, int mutations) {
  const auto inputs = corpus(name);
  ASSERT_GE(inputs.size(), 8u);
  const auto run = [&](const std::string& text) {
    EXPECT_NO_THROW(target(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()))
        << name << ": " << testing::PrintToString(text);
  };
  for (const std::string& text : inputs)
    run(text);
  std::mt19937_64 random(20'211);
  for (int i = 0; i < mutations; ++i)
    run(mutated(inputs, random));
}

TEST(FuzzReplay, Table) { replay("table", fuzz::table, 20'000); }

TEST(FuzzReplay, Step) { replay("step", fuzz::step, 20'000); }

TEST(FuzzReplay, Door) { replay("door", fuzz::door, 500); }

TEST(FuzzReplay, Options) {
  const fs::path before = fs::current_path();
  const Scratch scratch;
  fs::current_path(scratch);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  replay("options", fuzz::options, 1000);
  testing::internal::GetCapturedStdout();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("fuzz: "), std::string::npos);
  fs::current_path(before);
}

}  // namespace fuzz_replay_test
