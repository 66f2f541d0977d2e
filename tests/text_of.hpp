#pragma once
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

/// All that a file holds.
inline std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}
