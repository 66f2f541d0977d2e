#pragma once
#include "common/table.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

/// @file
/// The frame of every experiment: options, output folder, provenance, progress and exit status, so that an
/// experiment is its settings and its loop.

namespace CLI {
class App;  // Declared only: with its header, each experiment would compile ten seconds longer.
}

namespace experiment {

/// The running experiment: what its options say and where its tables go.
class Frame {
 public:
  std::string name;                ///< Stem of the executable, of its data file and of its figure.
  std::filesystem::path output;    ///< Folder of the data files.
  bool quick = false;              ///< A shortened run for tests: same columns, fewer or shorter rows.
  mutable bool line_open = false;  ///< Progress stands on the terminal.

  /// A table that begins with the provenance lines (experiment, commit, compiler, flags, libraries, machine,
  /// date).
  [[nodiscard]] experiment::Table table(std::vector<std::string> columns) const;

  /// Writes a table as <name>.tsv, or <name>_<curve>.tsv.
  void write(const experiment::Table& table, std::string_view curve = "") const;

  /// Shows `label` and which part of the work is done on a terminal; prints nothing in a pipe.
  void progress(std::string_view label, double done, double of = 1.0) const;
};

/// main() of an experiment. `shows` is what --help says of it: AVI_SHOWS, the sentence of its CMakeLists.txt.
/// `options` adds the experiment's own command-line options; `body` computes, then writes its tables last.
/// Returns the exit status: 0; 2 for bad options or a file or folder that cannot be read or written, with one
/// sentence on stderr and no half-written file; 1 for a run that failed.
int run(int argc, char** argv, const std::string& shows, const std::function<void(CLI::App&)>& options,
        const std::function<void(Frame&)>& body);

/// Same for an experiment without options of its own.
int run(int argc, char** argv, const std::string& shows, const std::function<void(Frame&)>& body);

/// Adds a switch.
void add_flag(CLI::App& app, const std::string& flag, bool& value, const std::string& description);

/// Adds a word or sentence.
void add_text(CLI::App& app, const std::string& flag, std::string& value, const std::string& description);

/// Adds the name of a folder that must exist.
void add_folder(CLI::App& app, const std::string& flag, std::filesystem::path& value,
                const std::string& description);

}  // namespace experiment
