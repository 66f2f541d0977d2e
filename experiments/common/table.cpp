#include "common/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace experiment {
namespace {

/// Rejects a table that would not read back the same.
void validate(const Table& table) {
  const auto one_line = [](const std::string& text) { return text.find('\n') == std::string::npos; };
  for (const auto& [key, value] : table.head)
    if (!one_line(key) || !one_line(value) || key.find(": ") != std::string::npos)
      throw std::invalid_argument("Note '" + key + ": " + value + "' does not fit in a line '# key: value'.");
  const auto check = [&](const std::vector<std::string>& cells) {
    if (cells.empty() || (cells.size() == 1 && cells[0].empty()) || cells[0].starts_with('#'))
      throw std::invalid_argument("A line of a table must not be empty or begin with '#'.");
    for (const std::string& cell : cells)
      if (!one_line(cell) || cell.find('\t') != std::string::npos)
        throw std::invalid_argument("Cell '" + cell + "' holds a tab or the end of a line.");
  };
  check(table.columns);
  for (const auto& cells : table.rows)
    check(cells);
}

void write_line(std::ostream& out, const std::vector<std::string>& cells) {
  out << fmt::format("{}\n", fmt::join(cells, "\t"));
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t tab; (tab = line.find('\t', begin)) != std::string::npos; begin = tab + 1)
    cells.push_back(line.substr(begin, tab - begin));
  cells.push_back(line.substr(begin));
  return cells;
}

}  // namespace

std::string exact(double value) { return rounded(value, 17); }

std::string rounded(double value, int digits) {
  if (std::isnan(value)) return "nan";
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

void Table::add(std::vector<std::string> cells) {
  if (cells.size() != columns.size())
    throw std::invalid_argument("A row has " + std::to_string(cells.size()) + " cells; it must have " +
                                std::to_string(columns.size()) + ", one for each column.");
  rows.push_back(std::move(cells));
}

std::size_t Table::column(std::string_view wanted) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == wanted) return i;
  throw std::out_of_range("There is no column '" + std::string(wanted) + "' in the table.");
}

const std::string& Table::text(std::size_t row, std::string_view wanted) const {
  return rows.at(row).at(column(wanted));
}

double Table::number(std::size_t row, std::string_view wanted) const {
  const std::string& cell = text(row, wanted);
  if (const auto value = number_in(cell)) return *value;
  throw std::invalid_argument("Cell '" + cell + "' of column '" + std::string(wanted) + "' is not a number.");
}

void Table::write(const std::filesystem::path& path) const {
  validate(*this);
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

void Table::print(std::ostream& out) const {
  for (const auto& [key, value] : head)
    out << "# " << key << ": " << value << '\n';
  write_line(out, columns);
  for (const auto& cells : rows)
    write_line(out, cells);
}

Table Table::read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (file) {
    Table table = parse(file, path.string());
    if (!file.bad()) return table;
  }
  throw FileError("Cannot read '" + path.string() + "'.");
}

Table Table::parse(std::istream& in, const std::string& name) {
  Table table;
  std::size_t number = 0;
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("Line " + std::to_string(number) + " of '" + name + "' " + what + ".");
  };
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (in.eof()) refuse("does not end; the file is cut off");
    if (line.starts_with("# ") && table.columns.empty()) {
      if (const auto colon = line.find(": "); colon != std::string::npos)
        table.head.emplace_back(line.substr(2, colon - 2), line.substr(colon + 2));
    } else if (!line.empty() && line.front() != '#') {
      std::vector<std::string> cells = split(line);
      if (table.columns.empty()) {
        for (auto cell = cells.begin(); cell != cells.end(); ++cell)
          if (std::find(cells.begin(), cell, *cell) != cell) refuse("names two columns '" + *cell + "'");
        table.columns = std::move(cells);
        continue;
      }
      if (cells.size() != table.columns.size())
        refuse("has " + std::to_string(cells.size()) + " cells; it must have " +
               std::to_string(table.columns.size()) + ", one for each column");
      table.rows.push_back(std::move(cells));
    }
  }
  if (table.columns.empty() && !in.bad()) {
    ++number;
    refuse("should be the header row; the file has none");
  }
  return table;
}

}  // namespace experiment
