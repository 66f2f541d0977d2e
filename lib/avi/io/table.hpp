#pragma once
#include <charconv>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

/// @file
/// The data contract: tab-separated tables with a `# key: value` head, one header row, then rows.

namespace avi {

/// A number with 17 significant digits, so that it reads back bit for bit; NaN is written `nan`.
inline std::string exact(double value) {
  if (std::isnan(value)) return "nan";
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 17).ptr;
  return {text, end};
}

/// A number with few digits, for seconds and other values that no one compares bit for bit.
inline std::string rounded(double value, int digits = 6) {
  if (std::isnan(value)) return "nan";
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

namespace detail {
inline std::string cell(const std::string& text) { return text; }
inline std::string cell(std::string_view text) { return std::string(text); }
inline std::string cell(const char* text) { return text; }
inline std::string cell(bool value) { return value ? "1" : "0"; }
inline std::string cell(std::floating_point auto value) { return exact(static_cast<double>(value)); }
inline std::string cell(std::integral auto value) { return std::to_string(value); }
}  // namespace detail

/// A table in memory. Rows are kept until write(), which renames a finished file into place: an interrupted
/// run leaves no half-written table.
class Table {
 public:
  std::vector<std::pair<std::string, std::string>> head;  ///< `# key: value` lines, in order.
  std::vector<std::string> columns;                       ///< snake_case names.
  std::vector<std::vector<std::string>> rows;

  Table() = default;
  explicit Table(std::vector<std::string> column_names) : columns(std::move(column_names)) {}

  /// Adds a `# key: value` line.
  template <class Value>
  void note(std::string key, const Value& value) {
    head.emplace_back(std::move(key), detail::cell(value));
  }

  /// Adds a row. @throws std::invalid_argument when it does not have one cell for each column.
  template <class... Values>
  void row(const Values&... values) {
    add({detail::cell(values)...});
  }

  /// Adds a row of finished cells; the same check.
  void add(std::vector<std::string> cells) {
    if (cells.size() != columns.size())
      throw std::invalid_argument("A row has " + std::to_string(cells.size()) + " cells; it must have " +
                                  std::to_string(columns.size()) + ", one for each column.");
    rows.push_back(std::move(cells));
  }

  /// Index of a column. @throws std::out_of_range naming a column that is not there.
  [[nodiscard]] std::size_t column(std::string_view wanted) const {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i] == wanted) return i;
    throw std::out_of_range("There is no column '" + std::string(wanted) + "' in the table.");
  }

  /// Cell of a row by column name.
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view wanted) const {
    return rows.at(row).at(column(wanted));
  }

  /// Cell of a row as a number. @throws std::invalid_argument when it is none.
  [[nodiscard]] double number(std::size_t row, std::string_view wanted) const {
    const std::string& cell = text(row, wanted);
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size())
      throw std::invalid_argument("Cell '" + cell + "' of column '" + std::string(wanted) +
                                  "' is not a number.");
    return value;
  }

  /// Writes to a temporary name beside `path` and renames it. @throws std::runtime_error when that fails;
  /// then neither file is left.
  void write(const std::filesystem::path& path) const {
    const auto temporary =
        path.parent_path() / ("." + path.filename().string() + "." + std::to_string(::getpid()));
    std::ofstream file(temporary, std::ios::binary);
    for (const auto& [key, value] : head)
      file << "# " << key << ": " << value << '\n';
    write_line(file, columns);
    for (const auto& cells : rows)
      write_line(file, cells);
    file.close();
    std::error_code error;
    if (file) std::filesystem::rename(temporary, path, error);
    if (!file || error) {
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      throw std::runtime_error("Cannot write '" + path.string() + "'.");
    }
  }

  /// Reads what write() wrote. @throws std::runtime_error for a file that cannot be read,
  /// std::invalid_argument for a row of the wrong length.
  static Table read(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("Cannot read '" + path.string() + "'.");
    Table table;
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("# ") && table.columns.empty()) {
        const auto colon = line.find(": ");
        if (colon == std::string::npos) continue;
        table.head.emplace_back(line.substr(2, colon - 2), line.substr(colon + 2));
      } else if (!line.empty() && line.front() != '#') {
        if (table.columns.empty())
          table.columns = split(line);
        else
          table.add(split(line));
      }
    }
    return table;
  }

 private:
  static void write_line(std::ostream& out, const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      out << (i ? "\t" : "") << cells[i];
    out << '\n';
  }

  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::size_t begin = 0;
    for (std::size_t tab; (tab = line.find('\t', begin)) != std::string::npos; begin = tab + 1)
      cells.push_back(line.substr(begin, tab - begin));
    cells.push_back(line.substr(begin));
    return cells;
  }
};

}  // namespace avi
