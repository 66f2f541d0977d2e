#pragma once
#include "scorecard/numbers/sheet.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// The ledger of claims: what the paper's text says, decided from the data of the experiments by one
/// principle. Methods are compared at matched accuracy, in steps, and in time too where a claim speaks of
/// time, cost or efficiency; an optimiser has converged when the stopping test holds from then on; a theorem
/// is proved elsewhere, and data are consistent with it or not. To add a claim, add its line to
/// paper/published/claims.tsv and a function to a claims_*.cpp.

namespace scorecard {

/// What became of a claim.
enum class Ruling {
  holds,       ///< In every case that the data contain.
  consistent,  ///< The claim is a theorem; data cannot show that it holds, and no case contradicts it.
  in_part,     ///< In some cases, or for one of the things it says.
  fails,       ///< The data say the opposite.
  undecided,   ///< Rests on a setting or a measure that the paper does not give, or on seconds too close to
               ///< call.
  missing      ///< No data to decide it by.
};
inline constexpr int rulings = 6;

/// The name used in data files.
std::string_view name(Ruling ruling);

/// A ruling and the numbers it rests on.
struct Finding {
  Ruling ruling = Ruling::missing;
  std::string evidence;
};

/// `holds` when it does in every case, `in_part` in some, `fails` in none.
Ruling in_cases(std::size_t holding, std::size_t cases);

/// For a theorem: `consistent` when no case contradicts it, else `fails`.
Ruling theorem(std::size_t holding, std::size_t cases);

/// The experiments' tables, each read when it is first asked for.
class Results {
 public:
  /// A table is taken from the first of the folders that has it.
  explicit Results(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  /// @throws std::runtime_error when no folder has the table.
  const experiment::Table& operator()(const std::string& stem) const;

  /// One number. @throws std::out_of_range where the row is not there.
  [[nodiscard]] double number(const std::string& stem,
                              std::initializer_list<std::pair<std::string_view, std::string_view>> where,
                              std::string_view column) const {
    const experiment::Table& table = (*this)(stem);
    return table.number(find(table, where), column);
  }

 private:
  std::vector<std::filesystem::path> folders_;
  mutable std::map<std::string, experiment::Table> tables_;
};

using Decision = Finding (*)(const Results&);

/// What decides a claim, by its key.
using Decisions = std::map<std::string_view, Decision>;
const Decisions& euler_b_decisions();    ///< Section 3.3, symplectic Euler-B.
const Decisions& htvi_decisions();       ///< Sections 2.2 and 3.3, HTVI.
const Decisions& structure_decisions();  ///< Sections 3.1, 3.3 and 4.4, what adaptivity keeps and gains.
const Decisions& dynamics_decisions();   ///< Sections 4.2 to 4.5.3, Bregman dynamics by symplectic methods.
const Decisions& optimiser_decisions();  ///< Sections 4.5.4 and 4.5.5, against other methods.

/// One line of the ledger.
struct ClaimLine {
  std::string source, key, claim, experiment, test;
  Finding finding;
};

/// Decides every claim of <published>/claims.tsv; what cannot be decided for want of data or of a decision is
/// `missing`, with the reason as its evidence.
std::vector<ClaimLine> judge_claims(const std::filesystem::path& published, const Results& results);

/// The ledger for a terminal.
std::string report(const std::vector<ClaimLine>& claims);

/// "36 claims: 20 hold, ...".
std::string summary(const std::vector<ClaimLine>& claims);

}  // namespace scorecard
