#pragma once
#include "scorecard/results.hpp"

#include <array>
#include <functional>

// The mechanism of the scorecard: one sheet for each published table, one judgement for each of its cells.
// To add a table, write its judge in a file of its own and name it in sheets().

namespace scorecard {

/// The verdict on a published number.
enum class Verdict {
  exact,      ///< Ours, rounded to the printed digits, is the printed number.
  within,     ///< Inside a tolerance that the note declares.
  differs,    ///< Neither.
  erratum,    ///< Evidence that the printed value or setting is a slip.
  unstated,   ///< Depends on a setting that the source does not give and that was not recovered.
  chaotic,    ///< Moves with the last bits; the note says whether the printed value is in their range.
  short_run,  ///< Our run is shorter than the printed count or bound, which it neither confirms nor refutes.
  missing     ///< No data to judge it by.
};
/// Their names in data files.
inline constexpr std::array<std::string_view, 8> verdicts{"exact",    "within",  "differs",   "erratum",
                                                          "unstated", "chaotic", "short run", "missing"};
inline std::string_view name(Verdict verdict) { return verdicts.at(static_cast<std::size_t>(verdict)); }

/// Our number and what it makes of the published one.
struct Judgement {
  std::string reproduced = "nan";
  Verdict verdict = Verdict::missing;
  std::string note;
  /// Our run has a setting other than the printed one, or a choice of construction that the printed formulas
  /// do not show, found with printed outcomes as the judge.
  bool recovered = false;
  /// Starts moved by 1e-14 give other counts.
  bool sensitive = false;
  /// printed, customary or recovered: see settings_of().
  std::string settings = "printed";
  std::string unprinted = "-";  ///< Settings that the source prints nowhere.
};

/// Where the settings of an outcome come from. `unprinted` lists those that the source prints nowhere (a
/// column of paper/published, - for none). With all of them printed agreement is a prediction. With no more
/// missing than the start, for which there is a custom, and the horizon, which is h times the steps of a row
/// with fixed steps, the settings are customary. Else one was found with printed outcomes as the judge, and
/// agreement judges that fit. The way of counting is no setting.
std::string settings_of(const std::string& unprinted, bool recovered);

/// One cell of a published table: a line of paper/published/<stem>.tsv with columns source, row, method, ...
class Cell : public Row {
 public:
  using Row::Row;
  [[nodiscard]] const std::string& quantity() const { return text("quantity"); }
  [[nodiscard]] const std::string& published() const { return text("published"); }

  /// The number that the same row of the paper's table prints for another quantity; empty where it prints
  /// nothing.
  [[nodiscard]] std::string sibling(std::string_view quantity) const {
    return elsewhere(text("row"), quantity);
  }

  /// The number that another row of the paper's table prints; empty where it prints nothing.
  [[nodiscard]] std::string elsewhere(std::string_view row, std::string_view quantity) const;
};

/// Judges every cell of one published table.
struct Sheet {
  std::string stem;   ///< Name of paper/published/<stem>.tsv and of the data file.
  std::string title;  ///< For people.
  /// An exception of it (a row that is not there, a cell that is no number) becomes the verdict `missing`.
  std::function<Judgement(const Cell&, const Table& data)> judge;
};

/// `exact` when `ours` rounds to the printed digits, `within` when it is at most `tolerance` units of the
/// last printed digit away, else `differs`; the note is kept.
Judgement compare(const Cell& cell, double ours, std::string note = "", double tolerance = 0.0);

/// Same for a count that the source begins `more` earlier than we do.
Judgement compare_count(const Cell& cell, double ours, double more, std::string note);

/// Same for what a run was made with: `exact` when it is the printed number, whatever its digits, else
/// `differs`.
Judgement compare_setting(const Cell& cell, double ours);

/// One line of the scorecard.
struct Line {
  std::string source, row, quantity, published;
  Judgement judgement;
};

/// Judges a whole sheet. @throws experiment::FileError when the published table cannot be read.
std::vector<Line> judge(const Sheet& sheet, const std::filesystem::path& published, const Results& data);

/// Tables 1 and 2: HTVI4 and Stormer-Verlet on Kepler's problem.
Judgement judge_kepler(const Cell& cell, const Table& data);

/// Tables 3 to 5: iterations of symplectic methods on Bregman dynamics.
Judgement judge_symplectic(const Cell& cell, const Table& data);

/// Table 6: iterations of several optimisers.
Judgement judge_optimisers(const Cell& cell, const Table& data);

/// The paper's tables in its order, which are counted without the one of formulas between the second and the
/// third.
inline std::vector<Sheet> sheets() {
  return {{"kepler_e090", "Table 1: Kepler, eccentricity 0.9", judge_kepler},
          {"kepler_e099", "Table 2: Kepler, eccentricity 0.99", judge_kepler},
          {"direct_vs_adaptive", "Table 3: Direct against Adaptive approach", judge_symplectic},
          {"method_comparison", "Table 4: symplectic integrators", judge_symplectic},
          {"p_dependence", "Table 5: dependence on p and p_ring", judge_symplectic},
          {"optimiser_comparison", "Table 6: optimisers over nine tolerances", judge_optimisers}};
}

}  // namespace scorecard
