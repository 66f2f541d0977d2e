#include "scorecard/shares.hpp"

#include "scorecard/claims.hpp"
#include "scorecard/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scorecard {

std::vector<Share> shares(const avi::Table& table, std::string_view column) {
  std::vector<std::string> names;
  for (int v = 0; v < verdicts; ++v)
    names.emplace_back(name(static_cast<Verdict>(v)));
  for (int r = 0; r < rulings; ++r)
    if (std::string ruling(name(static_cast<Ruling>(r))); std::ranges::find(names, ruling) == names.end())
      names.push_back(ruling);
  std::vector<Share> found;
  for (const std::string& each : names) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      count += table.text(i, column) == each;
    if (count > 0)
      found.push_back({each, count, static_cast<double>(count) / static_cast<double>(table.rows.size())});
  }
  return found;
}

std::string summary(std::string_view what, const std::vector<Share>& shares) {
  std::size_t all = 0;
  std::string out;
  for (const Share& share : shares) {
    out += fmt::format("{} {} {} ({:.1f} %)", out.empty() ? ":" : ",", share.count, share.name,
                       100.0 * share.part);
    all += share.count;
  }
  return fmt::format("{} {}{}.", all, what, out);
}

}  // namespace scorecard
