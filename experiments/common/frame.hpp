#pragma once
#include "common/table.hpp"

#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

// The common frame of all experiments: options, output folder, provenance, progress and exit status.

namespace experiment {

/// The running experiment: its options, its output folder and its tables.
class Frame {
 public:
  std::string name;                ///< Stem of the executable, of its data file and of its figure.
  std::filesystem::path output;    ///< Folder of the data files.
  bool quick = false;              ///< A shortened run for tests: same columns, fewer or shorter rows.
  bool longer = false;             ///< The longer run that the call of experiment() in CMake names.
  mutable bool line_open = false;  ///< A progress line is shown on the terminal.

  std::deque<std::pair<std::string, Table>> tables{};  ///< Those of table(), by curve.

  /// A new table for the file <name>.tsv, or <name>_<curve>.tsv, that begins with the provenance lines
  /// (experiment, commit, compiler, flags, libraries, machine, date). All are written when the body of run()
  /// has returned.
  Table& table(std::string_view curve, std::vector<std::string> columns);
  Table& table(std::vector<std::string> columns) { return table("", std::move(columns)); }

  /// Writes a table as <name>.tsv, or <name>_<curve>.tsv.
  void write(const Table& table, std::string_view curve = "") const;

  /// Writes all tables, that without a curve last: it tells `make` that all are there.
  void write_tables() const;

  /// Shows `label` and the part of the work that is done, on a terminal only.
  void progress(std::string_view label, double done, double of = 1.0) const;
};

/// A command-line option: a switch, a text, or the name of a folder that must exist.
struct Option {
  std::string flag;
  /// Holds the default, then the value given.
  std::variant<bool*, std::string*, std::filesystem::path*> value;
  std::string description;
};

/// Defined by each experiment: computes, and fills its tables. experiments/main.cpp calls it.
void conduct(Frame& frame);

/// main() of a program with a frame. @param shows the text for --help @param options the program's own
/// @param body computes; the tables are written when it has returned
/// @return the exit status: 0; 2 for bad options, or a file or folder that cannot be read or written, with
/// one sentence on stderr and no incomplete file; 1 for a run that failed
int run(int argc, char** argv, const std::string& shows, const std::vector<Option>& options,
        const std::function<void(Frame&)>& body);

}  // namespace experiment
