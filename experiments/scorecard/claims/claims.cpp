#include "scorecard/claims/claims.hpp"

#include "scorecard/wrapped.hpp"

#include <array>
#include <stdexcept>

namespace scorecard {

std::string_view name(Ruling ruling) {
  static constexpr std::array<std::string_view, rulings> names{"holds", "consistent", "in part",
                                                               "fails", "undecided",  "missing"};
  return names.at(static_cast<std::size_t>(ruling));
}

Ruling in_cases(std::size_t holding, std::size_t cases) {
  if (cases == 0) throw std::out_of_range("The data hold no case of this claim.");
  return holding == cases ? Ruling::holds : holding > 0 ? Ruling::in_part : Ruling::fails;
}

Ruling theorem(std::size_t holding, std::size_t cases) {
  return in_cases(holding, cases) == Ruling::holds ? Ruling::consistent : Ruling::fails;
}

const experiment::Table& Results::operator()(const std::string& stem) const {
  const auto known = tables_.find(stem);
  if (known != tables_.end()) return known->second;
  for (const auto& folder : folders_)
    if (const auto file = folder / (stem + ".tsv"); std::filesystem::exists(file))
      return tables_.emplace(stem, experiment::Table::read(file)).first->second;
  throw std::runtime_error("There are no data " + stem + ".tsv.");
}

std::vector<ClaimLine> judge_claims(const std::filesystem::path& published, const Results& results) {
  const experiment::Table ledger = experiment::Table::read(published / "claims.tsv");
  std::vector<ClaimLine> lines;
  for (std::size_t i = 0; i < ledger.rows.size(); ++i) {
    ClaimLine line{.source = ledger.text(i, "source"),
                   .key = ledger.text(i, "key"),
                   .claim = ledger.text(i, "claim"),
                   .experiment = ledger.text(i, "experiment"),
                   .test = ledger.text(i, "test"),
                   .finding = {Ruling::missing, "Nothing decides this claim."}};
    for (const auto* decisions : {&euler_b_decisions(), &htvi_decisions(), &structure_decisions(),
                                  &dynamics_decisions(), &optimiser_decisions()})
      if (const auto found = decisions->find(line.key); found != decisions->end()) try {
          line.finding = found->second(results);
        } catch (const std::exception& error) {
          line.finding = {Ruling::missing, error.what()};
        }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string summary(const std::vector<ClaimLine>& claims) {
  std::array<int, rulings> count{};
  for (const ClaimLine& line : claims)
    ++count.at(static_cast<std::size_t>(line.finding.ruling));
  std::string out = fmt::format("{} claims:", claims.size());
  const char* separator = " ";
  for (std::size_t r = 0; r < count.size(); ++r)
    if (count[r] > 0) {
      out += fmt::format("{}{} {}", separator, count[r], name(static_cast<Ruling>(r)));
      separator = ", ";
    }
  return out + ".";
}

std::string report(const std::vector<ClaimLine>& claims) {
  std::string out = fmt::format("\nClaims of the text - {}\n", summary(claims));
  for (const ClaimLine& line : claims) {
    out += fmt::format("  {:<9} {:<14} {}\n", name(line.finding.ruling), line.source, line.claim);
    if (line.finding.ruling != Ruling::holds) out += wrapped(line.finding.evidence, 4);
  }
  return out;
}

}  // namespace scorecard
