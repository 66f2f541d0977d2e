#include "scorecard/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace scorecard {
namespace {

constexpr std::size_t text_width = 110;
constexpr std::ptrdiff_t listed_singly = 9;  ///< Longer groups with one verdict and note are counted.

/// Breaks `text` into lines of at most `text_width` columns, each indented.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out, line;
  const auto flush = [&] { out += std::string(indent, ' ') + line + '\n', line.clear(); };
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && indent + line.size() + 1 + word.size() > text_width) flush();
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  if (!line.empty()) flush();
  return out;
}

}  // namespace

std::string summary(const std::vector<Line>& lines) {
  std::array<int, verdicts> count{};
  for (const Line& line : lines)
    ++count.at(static_cast<std::size_t>(line.judgement.verdict));
  std::string out = fmt::format("{} published numbers:", lines.size());
  const char* separator = " ";
  for (std::size_t v = 0; v < count.size(); ++v)
    if (count[v] > 0) {
      out += fmt::format("{}{} {}", separator, count[v], name(static_cast<Verdict>(v)));
      separator = ", ";
    }
  return out + ".";
}

std::string report(const std::string& title, const std::vector<Line>& lines) {
  std::string out = fmt::format("\n{} - {}\n", title, summary(lines));
  for (auto first = lines.begin(); first != lines.end();) {
    const Judgement& judgement = first->judgement;
    const auto last = std::find_if(first, lines.end(), [&](const Line& line) {
      return line.judgement.verdict != judgement.verdict || line.judgement.note != judgement.note;
    });
    if (judgement.verdict != Verdict::exact) {
      if (last - first > listed_singly)
        out += fmt::format("  {:<9} {} cells, {} {} to {} {}\n", name(judgement.verdict), last - first,
                           first->row, first->quantity, (last - 1)->row, (last - 1)->quantity);
      else
        for (auto line = first; line != last; ++line)
          out += fmt::format("  {:<9} {:<24} {:<13} printed {:<10} ours {}\n", name(judgement.verdict),
                             line->row, line->quantity, line->published, line->judgement.reproduced);
      out += wrapped(judgement.note, 4);
    }
    first = last;
  }
  return out;
}

}  // namespace scorecard
