#include "common/provenance.hpp"

#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>

namespace experiment {

std::string commit() {
  // Asked at run time: compiled in, a new commit would relink and so re-run every experiment.
  const std::string command =
      "git -C '" AVI_SOURCE_DIR "' describe --always --dirty --exclude='*' 2>/dev/null";
  std::string text;
  if (FILE* pipe = ::popen(command.c_str(), "r")) {
    std::array<char, 128> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe))
      text += buffer.data();
    ::pclose(pipe);
  }
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text.empty() ? "unknown" : text;
}

std::string compiler() { return AVI_COMPILER; }

std::string flags(const std::string& experiment) {
  // Of two levels of optimisation the later counts.
  const bool is_short = std::string(AVI_SHORT " ").find(" " + experiment + " ") != std::string::npos;
  return is_short ? AVI_FLAGS " " AVI_NOT_OPTIMISED : AVI_FLAGS;
}

std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text.data();
}

}  // namespace experiment
