#pragma once
#include "common/table.hpp"

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The experiments' tables, row by row.

namespace scorecard {

using experiment::Table, experiment::rounded;

/// The same text, or the same number.
bool same(std::string_view a, std::string_view b);

/// A row of a table; the table must outlive it.
class Row {
 public:
  Row(const Table& table, std::size_t line) : table_(&table), line_(line) {}

  /// A cell. @throws std::out_of_range naming a column that is not there.
  [[nodiscard]] const std::string& text(std::string_view column) const { return table_->text(line_, column); }
  /// A cell as a number. @throws std::invalid_argument when it is none, and as text().
  [[nodiscard]] double number(std::string_view column) const { return table_->number(line_, column); }
  /// Place in the table, from 0 on.
  [[nodiscard]] std::size_t line() const { return line_; }

 protected:
  const Table* table_;
  std::size_t line_;
};

/// Columns, and the text or number that is wanted in each.
using Cells = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// The rows that hold these cells.
std::vector<Row> rows(const Table& table, Cells wanted = {});

/// The first of them. @throws std::out_of_range saying what was looked for when there is none.
Row find(const Table& table, Cells wanted);

/// The experiments' tables by stem, each read when it is first asked for.
class Results {
 public:
  /// A table is taken from the first of the folders that has it.
  explicit Results(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  /// @throws std::runtime_error when no folder has the table.
  const Table& operator()(const std::string& stem) const;

  /// Rows of a table, and one of its cells; errors of both.
  [[nodiscard]] std::vector<Row> rows(const std::string& stem, Cells wanted = {}) const {
    return scorecard::rows((*this)(stem), wanted);
  }
  [[nodiscard]] double number(const std::string& stem, Cells wanted, std::string_view column) const {
    return find((*this)(stem), wanted).number(column);
  }

 private:
  std::vector<std::filesystem::path> folders_;
  mutable std::map<std::string, Table> tables_;
};

}  // namespace scorecard
