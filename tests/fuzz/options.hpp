#pragma once
#include "common/frame.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// Any lines as the arguments of an experiment: status 0 with a folder that exists, or status 2.

namespace fuzz {

/// The caller's working directory gets the folder build/data.
inline void options(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> arguments{"fuzz", ""};
  for (std::size_t i = 0; i < size && arguments.size() < 32; ++i) {
    if (data[i] == '\n')
      arguments.emplace_back();
    else if (data[i] != '\0')
      arguments.back() += static_cast<char>(data[i]);
  }
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    if (argument.find("output") != std::string::npos) return;  // it would make folders anywhere
    argv.push_back(argument.data());
  }
  bool flag = false, sound = true;
  std::filesystem::path folder = ".";
  const int status =
      experiment::run(static_cast<int>(argv.size()), argv.data(), "A summary",
                      {{"--flag", &flag, "A flag"}, {"--folder", &folder, "A folder"}},
                      [&](experiment::Frame&) { sound = std::filesystem::is_directory(folder); });
  if (status != 0 && status != 2) throw std::logic_error("Status " + std::to_string(status) + ".");
  if (!sound) throw std::logic_error("A folder that does not exist was taken.");
}

}  // namespace fuzz
