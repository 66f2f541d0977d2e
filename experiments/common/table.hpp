#pragma once
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstring>
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

namespace experiment {

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

/// A file that cannot be read or written.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A table in memory. Rows are kept until write(), which renames a finished file into place: an interrupted
/// run leaves no half-written table.
class Table {
 public:
  std::vector<std::pair<std::string, std::string>> head;  ///< `# key: value` lines, in order.
  std::vector<std::string> columns;                       ///< snake_case names.
  std::vector<std::vector<std::string>> rows;             ///< Cells as they stand in the file.

  Table() = default;
  /// A table without rows.
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

  /// Writes to a temporary name beside `path` and renames it. @throws FileError when that fails; then neither
  /// file is left. @throws std::invalid_argument for cells that would not read back.
  void write(const std::filesystem::path& path) const {
    validate();
    const auto temporary =
        path.parent_path() / ("." + path.filename().string() + "." + std::to_string(::getpid()));
    errno = 0;
    std::ofstream file(temporary, std::ios::binary);
    print(file);
    file.close();
    std::error_code error;
    if (file) std::filesystem::rename(temporary, path, error);
    if (file && !error) return;
    const std::string reason = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(temporary, error);
    throw FileError("Cannot write '" + path.string() + "': " + reason + ".");
  }

  /// Writes the lines of the file.
  void print(std::ostream& out) const {
    for (const auto& [key, value] : head)
      out << "# " << key << ": " << value << '\n';
    write_line(out, columns);
    for (const auto& cells : rows)
      write_line(out, cells);
  }

  /// Reads what write() wrote. @throws FileError for a file that cannot be read, std::invalid_argument as
  /// parse().
  static Table read(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (file) {
      Table table = parse(file, path.string());
      if (!file.bad()) return table;
    }
    throw FileError("Cannot read '" + path.string() + "'.");
  }

  /// Reads the lines of a file. @throws std::invalid_argument, naming the file and the line, where there is
  /// no header row, a row has the wrong length, a name stands for two columns, or the file ends within a
  /// line.
  static Table parse(std::istream& in, const std::string& name) {
    Table table;
    std::size_t number = 0;
    const auto refuse = [&](const std::string& what) {
      throw std::invalid_argument("Line " + std::to_string(number) + " of '" + name + "' " + what + ".");
    };
    for (std::string line; std::getline(in, line);) {
      ++number;
      if (in.eof()) refuse("does not end; the file is cut off");
      if (line.starts_with("# ") && table.columns.empty()) {
        const auto colon = line.find(": ");
        if (colon == std::string::npos) continue;
        table.head.emplace_back(line.substr(2, colon - 2), line.substr(colon + 2));
      } else if (!line.empty() && line.front() != '#') {
        std::vector<std::string> cells = split(line);
        if (!table.columns.empty() && cells.size() != table.columns.size())
          refuse("has " + std::to_string(cells.size()) + " cells; it must have " +
                 std::to_string(table.columns.size()) + ", one for each column");
        if (!table.columns.empty()) {
          table.rows.push_back(std::move(cells));
          continue;
        }
        std::vector<std::string> sorted = cells;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
          refuse("names two columns '" + *std::adjacent_find(sorted.begin(), sorted.end()) + "'");
        table.columns = std::move(cells);
      }
    }
    if (table.columns.empty() && !in.bad()) {
      ++number;
      refuse("should be the header row; the file has none");
    }
    return table;
  }

 private:
  /// Refuses what would read back as something else.
  void validate() const {
    const auto one_line = [](const std::string& text) { return text.find('\n') == std::string::npos; };
    for (const auto& [key, value] : head)
      if (!one_line(key) || !one_line(value) || key.find(": ") != std::string::npos)
        throw std::invalid_argument("Note '" + key + ": " + value +
                                    "' does not fit in a line '# key: value'.");
    const auto check = [&](const std::vector<std::string>& cells) {
      if (cells.empty() || (cells.size() == 1 && cells[0].empty()) || cells[0].starts_with('#'))
        throw std::invalid_argument("A line of a table must not be empty or begin with '#'.");
      for (const std::string& cell : cells)
        if (!one_line(cell) || cell.find('\t') != std::string::npos)
          throw std::invalid_argument("Cell '" + cell + "' holds a tab or the end of a line.");
    };
    check(columns);
    for (const auto& cells : rows)
      check(cells);
  }

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

}  // namespace experiment
