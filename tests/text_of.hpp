#pragma once
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

/// All that a file holds.
inline std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

/// First groups of all matches in a text.
inline std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> groups;
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i)
    groups.push_back((*i)[1]);
  return groups;
}

/// Whether a file of that name lies in some chapter of a folder of this repository.
inline bool lies_in(const char* folder, const std::string& name) {
  namespace fs = std::filesystem;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(AVI_SOURCE_DIR) / folder))
    if (entry.path().filename() == name) return true;
  return false;
}
