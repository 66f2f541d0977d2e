#pragma once
#include "common/table.hpp"

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// @file
/// The mechanism of the scorecard: one sheet for each published table, one judgement for each of its cells.
/// To add a table, write a function that returns its Sheet in a file of its own and name it in sheets.hpp.

namespace scorecard {

/// What became of a published number.
enum class Verdict {
  exact,     ///< Ours, rounded to the printed digits, is the printed number.
  within,    ///< Inside a tolerance that the note declares.
  differs,   ///< Neither.
  erratum,   ///< Evidence that the printed value or setting is a slip.
  unstated,  ///< Depends on a setting that the source does not give and that was not recovered.
  chaotic,  ///< Moves with the last bit; the note says whether the printed value lies in the perturbed range.
  missing   ///< No data to judge it by.
};
inline constexpr int verdicts = 7;

/// The name used in data files.
std::string_view name(Verdict verdict);

/// Our number and what it makes of the published one.
struct Judgement {
  std::string reproduced = "nan";
  Verdict verdict = Verdict::missing;
  std::string note;
  /// Our run has a setting or a choice of construction that is not printed and was found with printed
  /// outcomes as the judge: agreement judges that fit, it does not predict. The way of counting is no
  /// setting.
  bool recovered = false;
};

/// "printed" or "recovered": what the settings of a judgement's run are, as data files have it.
std::string_view settings_of(const Judgement& judgement);

/// One cell of a published table: a line of paper/published/<stem>.tsv.
class Cell {
 public:
  Cell(const experiment::Table& table, std::size_t line) : table_(&table), line_(line) {}

  /// Any column of the line: source, row, method, ...
  [[nodiscard]] const std::string& text(std::string_view column) const { return table_->text(line_, column); }
  [[nodiscard]] const std::string& quantity() const { return text("quantity"); }
  [[nodiscard]] const std::string& published() const { return text("published"); }

  /// What the same row of the paper's table prints for another quantity; empty where it prints nothing.
  [[nodiscard]] std::string sibling(std::string_view quantity) const {
    return elsewhere(text("row"), quantity);
  }

  /// What another row of the paper's table prints; empty where it prints nothing.
  [[nodiscard]] std::string elsewhere(std::string_view row, std::string_view quantity) const;

 private:
  const experiment::Table* table_;
  std::size_t line_;
};

/// Judges every cell of one published table.
struct Sheet {
  std::string stem;   ///< Of paper/published/<stem>.tsv and of the data file.
  std::string title;  ///< For people.
  /// What it throws (a row that is not there, a cell that is no number) becomes the verdict `missing`.
  std::function<Judgement(const Cell&, const experiment::Table& data)> judge;
};

/// `exact` when `ours` rounds to the printed digits, `within` when it is at most `tolerance` units of the
/// last printed digit away, else `differs`; the note is kept.
Judgement compare(const Cell& cell, double ours, std::string note = "", double tolerance = 0.0);

/// The same text, or the same number.
bool same(std::string_view a, std::string_view b);

/// The line of `data` in which every named column holds the wanted text, or the same number.
/// @throws std::out_of_range saying what was looked for when there is none.
std::size_t find(const experiment::Table& data,
                 std::initializer_list<std::pair<std::string_view, std::string_view>> wanted);

/// One line of the scorecard.
struct Line {
  std::string source, row, quantity, published;
  Judgement judgement;
};

/// Judges a whole sheet from the two folders. @throws std::runtime_error when the published table cannot be
/// read.
std::vector<Line> judge(const Sheet& sheet, const std::filesystem::path& published,
                        const std::filesystem::path& data);

}  // namespace scorecard
