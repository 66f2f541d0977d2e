#include "scorecard/report.hpp"

#include "scorecard/wrapped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace scorecard {
namespace {

constexpr std::ptrdiff_t listed_singly = 9;  ///< Longer groups with one verdict and note are counted.

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
