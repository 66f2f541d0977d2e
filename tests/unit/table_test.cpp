#include "common/table.hpp"

#include "refusal.hpp"
#include "scratch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

using experiment::Table;

namespace table_test {

TEST(Table, ReadsBackWhatItWroteBitForBit) {
  const Scratch folder;
  Table table({"name", "value", "count"});
  table.note("setting", 0.1);
  const double third = 1.0 / 3.0;
  table.row("a", third, 42L);
  table.row("b", std::numeric_limits<double>::quiet_NaN(), -1);
  table.write(folder / "t.tsv");
  const Table back = Table::read(folder / "t.tsv");
  EXPECT_EQ(back.columns, table.columns);
  EXPECT_EQ(back.rows, table.rows);
  EXPECT_EQ(back.head, table.head);
  EXPECT_EQ(back.number(0, "value"), third);
  EXPECT_TRUE(std::isnan(back.number(1, "value")));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 1u) << "a temporary file was left";
}

TEST(Table, RefusesWhatDoesNotFit) {
  Table table({"a", "b"});
  EXPECT_THROW(table.row(1), std::invalid_argument);
  EXPECT_THROW((void)table.column("c"), std::out_of_range);
  table.row("word", 1);
  EXPECT_THROW((void)table.number(0, "a"), std::invalid_argument);
  EXPECT_THROW(table.write("/dev/null/nowhere/t.tsv"), std::runtime_error);
  EXPECT_THROW(Table::read("/dev/null/nowhere/t.tsv"), experiment::FileError);
  EXPECT_THROW(Table::read(std::filesystem::temp_directory_path()), experiment::FileError)
      << "a folder is no table";
}

std::string refusal(const std::string& text) {
  std::istringstream file(text);
  return ::refusal([&] { Table::parse(file, "t.tsv"); });
}

TEST(Table, RefusesFilesThatAreNotWhole) {
  EXPECT_EQ(refusal("# note: x\na\tb\n1\t2\n"), "accepted");
  EXPECT_EQ(refusal("a\tb\n1\t2"), "Line 2 of 't.tsv' does not end; the file is cut off.");
  EXPECT_EQ(refusal("a\tb\n1\n"), "Line 2 of 't.tsv' has 1 cells; it must have 2, one for each column.");
  EXPECT_EQ(refusal(""), "Line 1 of 't.tsv' should be the header row; the file has none.");
  EXPECT_EQ(refusal("# note: x\n"), "Line 2 of 't.tsv' should be the header row; the file has none.");
  EXPECT_EQ(refusal("a\tb\ta\n"), "Line 1 of 't.tsv' names two columns 'a'.");
}

TEST(Table, WritesNothingThatWouldReadBackAsSomethingElse) {
  const Scratch folder;
  const auto refuses = [&](const Table& table) {
    EXPECT_THROW(table.write(folder / "t.tsv"), std::invalid_argument);
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << "a file was left";
  };
  for (const char* cell : {"a\tb", "a\nb", "#a", ""}) {
    Table table({"x"});
    table.row(cell);
    refuses(table);
    refuses(Table({cell}));
  }
  refuses(Table());
  Table noted({"x"});
  noted.note("key", "two\nlines");
  refuses(noted);
}

}  // namespace table_test
