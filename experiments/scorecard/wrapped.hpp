#pragma once
#include <algorithm>
#include <string>

/// @file
/// Text broken into lines.

namespace scorecard {

/// Breaks `text` into lines of at most 110 columns, each indented.
inline std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t width = 110;
  std::string out, line;
  const auto flush = [&] { out += std::string(indent, ' ') + line + '\n', line.clear(); };
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) flush();
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  if (!line.empty()) flush();
  return out;
}

}  // namespace scorecard
