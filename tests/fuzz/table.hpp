#pragma once
#include "common/table.hpp"

#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

/// @file
/// Any bytes as a data file: refused, or a table that reads back as it was.

namespace fuzz {

inline void table(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(reinterpret_cast<const char*>(data), size));
  experiment::Table read;
  try {
    read = experiment::Table::parse(file, "input");
  } catch (const std::invalid_argument&) {
    return;
  }
  for (const auto& row : read.rows)
    if (row.size() != read.columns.size()) throw std::logic_error("A row of another length was taken.");
  for (std::size_t i = 0; i < read.rows.size(); ++i)
    for (const std::string& column : read.columns) {
      try {
        const double value = read.number(i, column);
        experiment::Table one({"x"});
        one.row(value);
        if (!std::isnan(value) && one.number(0, "x") != value) throw std::logic_error("A number changed.");
      } catch (const std::invalid_argument&) {
      }
    }
  std::stringstream again;
  read.print(again);
  const experiment::Table back = experiment::Table::parse(again, "again");
  if (back.head != read.head || back.columns != read.columns || back.rows != read.rows)
    throw std::logic_error("A table does not read back as it was.");
}

}  // namespace fuzz
