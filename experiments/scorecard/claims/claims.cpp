#include "scorecard/claims/claims.hpp"

#include <algorithm>
#include <stdexcept>

namespace scorecard {

void Cases::add(bool holds, double value) {
  ++all;
  holding += holds;
  least = std::fmin(least, value);
  most = std::fmax(most, value);
}

Cases operator+(Cases first, const Cases& second) {
  return {first.all + second.all, first.holding + second.holding, std::min(first.least, second.least),
          std::max(first.most, second.most)};
}

Ruling in_cases(const Cases& cases) {
  if (cases.all == 0) throw std::out_of_range("The data hold no case of this claim.");
  return cases.holding == cases.all ? Ruling::holds : cases.holding > 0 ? Ruling::in_part : Ruling::fails;
}

Ruling theorem(const Cases& cases) {
  return in_cases(cases) == Ruling::holds ? Ruling::consistent : Ruling::fails;
}

bool Comparison::has(std::string_view monitor) const {
  return std::ranges::any_of(runs, [&](const Row& run) { return run.text("monitor") == monitor; });
}

double Comparison::operator()(std::string_view monitor, std::string_view column) const {
  for (const Row& run : runs)
    if (run.text("monitor") == monitor) return run.number(column);
  throw std::out_of_range(fmt::format("The data have no run with monitor {}.", monitor));
}

std::vector<Comparison> comparisons(const Table& table, std::initializer_list<std::string_view> columns,
                                    std::initializer_list<std::string_view> monitors) {
  std::vector<Comparison> all;
  for (const Row& row : rows(table)) {
    const auto takes_part = [&](const Comparison& comparison) {
      return std::ranges::all_of(
          columns, [&](auto column) { return row.text(column) == comparison.runs.front().text(column); });
    };
    const auto known = std::ranges::find_if(all, takes_part);
    (known == all.end() ? all.emplace_back() : *known).runs.push_back(row);
  }
  std::erase_if(all, [&](const Comparison& comparison) {
    return !std::ranges::all_of(monitors, [&](auto monitor) { return comparison.has(monitor); });
  });
  return all;
}

Cases more_than(double bound, const std::vector<Comparison>& comparisons, std::string_view column,
                std::string_view monitor, std::string_view other) {
  Cases cases;
  for (const Comparison& comparison : comparisons) {
    const double ratio = comparison.ratio(column, monitor, other);
    cases.add(ratio > bound, ratio);
  }
  return cases;
}

Decisions all_decisions() {
  Decisions all;
  for (const auto chapter :
       {euler_b_decisions, htvi_decisions, structure_decisions, dynamics_decisions, optimiser_decisions})
    all.merge(chapter());
  return all;
}

std::vector<ClaimLine> judge_claims(const std::filesystem::path& published, const Results& results) {
  const Decisions decisions = all_decisions();
  std::vector<ClaimLine> lines;
  const Table ledger = Table::read(published / "claims.tsv");
  for (const Row& row : rows(ledger)) {
    Finding finding{Ruling::missing, "Nothing decides this claim."};
    if (const auto found = decisions.find(row.text("key")); found != decisions.end()) try {
        finding = found->second(results);
      } catch (const std::exception& error) {
        finding.evidence = error.what();
      }
    lines.push_back({row.text("source"), row.text("key"), row.text("claim"), row.text("experiment"),
                     row.text("test"), std::move(finding)});
  }
  return lines;
}

}  // namespace scorecard
