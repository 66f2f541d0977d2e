#pragma once
#include "scorecard/results.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

// The ledger of claims: what the paper's text says, decided from the data of the experiments by one
// principle. Methods are compared at matched accuracy, in steps, and in time too where a claim speaks of
// time, cost or efficiency; an optimiser has converged when the stopping test holds from then on; a theorem
// is proved elsewhere, and data are consistent with it or not. To add a claim, add its line to
// paper/published/claims.tsv and a function to a claims_*.cpp.

namespace scorecard {

/// The ruling on a claim.
enum class Ruling {
  holds,       ///< In every case that the data contain.
  consistent,  ///< The claim is a theorem; data cannot show that it holds, and no case contradicts it.
  in_part,     ///< In some cases, or for one of the things it says.
  fails,       ///< The data say the opposite.
  undecided,   ///< Rests on what the paper does not give, seconds too close to call, or a longer run than
               ///< ours.
  missing      ///< No data to decide it by.
};
/// Their names in data files.
inline constexpr std::array<std::string_view, 6> rulings{"holds", "consistent", "in part",
                                                         "fails", "undecided",  "missing"};
inline std::string_view name(Ruling ruling) { return rulings.at(static_cast<std::size_t>(ruling)); }

/// A ruling and the numbers it rests on.
struct Finding {
  Ruling ruling = Ruling::missing;
  std::string evidence;
};

/// With the evidence in fmt's format.
template <class... Values>
Finding finding(Ruling ruling, fmt::format_string<Values...> evidence, Values&&... values) {
  return {ruling, fmt::format(evidence, std::forward<Values>(values)...)};
}

/// The cases of a claim, and in how many it holds; least and largest of a number that some of them have.
struct Cases {
  std::size_t all = 0, holding = 0;
  double least = HUGE_VAL, most = -HUGE_VAL;

  void add(bool holds, double value = std::nan(""));
};
Cases operator+(Cases first, const Cases& second);

/// `holds` when it does in every case, `in_part` in some, `fails` in none. @throws std::out_of_range without
/// a case.
Ruling in_cases(const Cases& cases);

/// For a theorem: `consistent` when no case contradicts it, else `fails`; the same error.
Ruling theorem(const Cases& cases);

/// Runs that are compared with each other: rows that agree in some columns, told apart by their monitors.
struct Comparison {
  std::vector<Row> runs;

  [[nodiscard]] bool has(std::string_view monitor) const;
  /// A number of the run with this monitor. @throws std::out_of_range when there is none.
  [[nodiscard]] double operator()(std::string_view monitor, std::string_view column) const;
  /// The same number of one run over that of another.
  [[nodiscard]] double ratio(std::string_view column, std::string_view monitor,
                             std::string_view other) const {
    return (*this)(monitor, column) / (*this)(other, column);
  }
};

/// The comparisons in a table whose rows agree in these columns and which have all these monitors.
std::vector<Comparison> comparisons(const Table& table, std::initializer_list<std::string_view> columns,
                                    std::initializer_list<std::string_view> monitors);

/// The comparisons as cases that hold where a number of one run is more than `bound` times that of another.
Cases more_than(double bound, const std::vector<Comparison>& comparisons, std::string_view column,
                std::string_view monitor, std::string_view other);

/// The functions that decide claims, by their keys.
using Decisions = std::map<std::string, Finding (*)(const Results&)>;
Decisions euler_b_decisions();    ///< Section 3.3, symplectic Euler-B.
Decisions htvi_decisions();       ///< Sections 2.2 and 3.3, HTVI.
Decisions structure_decisions();  ///< Sections 3.1, 3.3 and 4.4, what adaptivity keeps and gains.
Decisions dynamics_decisions();   ///< Sections 4.2 to 4.5.3, Bregman dynamics by symplectic methods.
Decisions optimiser_decisions();  ///< Sections 4.5.4 and 4.5.5, against other methods.
Decisions all_decisions();        ///< All of them.

/// One line of the ledger.
struct ClaimLine {
  std::string source, key, claim, experiment, test;
  Finding finding;
};

/// Decides every claim of <published>/claims.tsv; what cannot be decided for want of data or of a decision is
/// `missing`, with the reason as its evidence.
std::vector<ClaimLine> judge_claims(const std::filesystem::path& published, const Results& results);

}  // namespace scorecard
