#pragma once
#include <concepts>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The format of data files: tab-separated tables with `# key: value` lines, one header row, then rows.

namespace experiment {

/// Marks a cell without a number: NaN.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A number with 17 significant digits, so that it reads back bit for bit; NaN is written `nan`.
std::string exact(double value);

/// A number with few digits, for seconds and other values that are not compared bit for bit.
std::string rounded(double value, int digits = 6);

/// The number that the whole text represents; nothing if it is none.
std::optional<double> number_in(std::string_view text);

namespace detail {
inline std::string cell(const std::string& text) { return text; }
inline std::string cell(std::string_view text) { return std::string(text); }
inline std::string cell(const char* text) { return text; }
inline std::string cell(bool value) { return value ? "1" : "0"; }
inline std::string cell(std::floating_point auto value) { return exact(static_cast<double>(value)); }
inline std::string cell(std::integral auto value) { return std::to_string(value); }
}  // namespace detail

/// A file that cannot be read or written.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A table in memory. It reaches the disk only with write(), which renames a complete file into place, so
/// that an interrupted run leaves no incomplete table.
class Table {
 public:
  std::vector<std::pair<std::string, std::string>> head;  ///< `# key: value` lines, in order.
  std::vector<std::string> columns;                       ///< snake_case names.
  std::vector<std::vector<std::string>> rows;             ///< Cells as written in the file.

  Table() = default;
  /// A table without rows.
  explicit Table(std::vector<std::string> column_names) : columns(std::move(column_names)) {}

  /// Adds a `# key: value` line.
  void note(std::string key, const auto& value) { head.emplace_back(std::move(key), detail::cell(value)); }

  /// Adds a row. @throws std::invalid_argument when it does not have one cell for each column.
  template <class... Values>
  void row(const Values&... values) {
    add({detail::cell(values)...});
  }

  /// Adds a row of cells that are already text; the same check applies.
  void add(std::vector<std::string> cells);

  /// Index of a column. @throws std::out_of_range for a column that does not exist.
  [[nodiscard]] std::size_t column(std::string_view wanted) const;

  /// Cell of a row by column name.
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view wanted) const;

  /// Cell of a row as a number. @throws std::invalid_argument if it is not a number.
  [[nodiscard]] double number(std::size_t row, std::string_view wanted) const;

  /// Writes to a temporary file beside `path` and renames it. @throws FileError if that fails; no incomplete
  /// file is left. @throws std::invalid_argument for cells that would not read back.
  void write(const std::filesystem::path& path) const;

  /// Writes the table as text, as in a file.
  void print(std::ostream& out) const;

  /// Reads a file written by write(). @throws FileError for a file that cannot be read, std::invalid_argument
  /// as parse().
  static Table read(const std::filesystem::path& path);

  /// Reads a table from text. @throws std::invalid_argument, naming the file and the line, if there is no
  /// header row, a row has the wrong number of cells, two columns have the same name, or the text ends within
  /// a line.
  static Table parse(std::istream& in, const std::string& name);
};

}  // namespace experiment
