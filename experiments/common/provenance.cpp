#include "common/frame.hpp"

#include <Eigen/Core>
#include <fmt/chrono.h>
#include <gsl/gsl_version.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>

// Provenance lines of a data file.

namespace experiment {
namespace {

/// `git describe --always --dirty` of the source folder, or "unknown".
std::string commit() {
  // Queried at run time: if it were compiled in, each commit would relink and so rerun every experiment. The
  // check for CMakeLists.txt covers a release without .git inside another repository, whose commit would be
  // misleading.
  const std::string command =
      "cd '" AVI_SOURCE_DIR "' && git ls-files --error-unmatch CMakeLists.txt >/dev/null 2>&1 && "
      "git describe --always --dirty --exclude='*' 2>/dev/null";
  std::array<char, 128> line{};
  if (FILE* pipe = ::popen(command.c_str(), "r")) {
    if (!std::fgets(line.data(), line.size(), pipe)) line[0] = '\0';
    ::pclose(pipe);
  }
  const std::string text(line.data(), std::strcspn(line.data(), "\n"));
  return text.empty() ? "unknown" : text;
}

/// Compiler flags of an experiment.
std::string flags(const std::string& experiment) {
  // The last of several optimisation levels takes effect.
  const bool is_short = std::string(AVI_SHORT " ").find(" " + experiment + " ") != std::string::npos;
  return is_short ? AVI_FLAGS " " AVI_NOT_OPTIMISED : AVI_FLAGS;
}

/// Model of the processor.
std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

Table& Frame::table(std::string_view curve, std::vector<std::string> columns) {
  Table& table = tables.emplace_back(curve, Table(std::move(columns))).second;
  table.note("experiment", name);
  table.note("commit", commit());
  table.note("compiler", AVI_COMPILER);
  table.note("flags", flags(name));
  table.note("libraries", fmt::format("Eigen {}.{}.{}, GSL " GSL_VERSION, EIGEN_WORLD_VERSION,
                                      EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  table.note("machine", machine());
  table.note("date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
  table.note("quick", quick);
  return table;
}

}  // namespace experiment
