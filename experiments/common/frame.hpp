#pragma once
#include "common/table.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

// What every experiment has beside settings and loop: options, folder, provenance, progress, exit status.

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
  [[nodiscard]] Table table(std::vector<std::string> columns) const;

  /// Writes a table as <name>.tsv, or <name>_<curve>.tsv.
  void write(const Table& table, std::string_view curve = "") const;

  /// Shows `label` and which part of the work is done on a terminal; prints nothing in a pipe.
  void progress(std::string_view label, double done, double of = 1.0) const;
};

/// An option of the command line: a switch, a word or sentence, or the name of a folder that must exist.
struct Option {
  std::string flag;
  std::variant<bool*, std::string*, std::filesystem::path*> value;  ///< Its default, then what is given.
  std::string description;
};

/// main() of an experiment. `shows` is what --help says of it: AVI_SHOWS, the sentence of its CMakeLists.txt.
/// `options` are the experiment's own; `body` computes, then writes its tables last.
/// Returns the exit status: 0; 2 for bad options or a file or folder that cannot be read or written, with one
/// sentence on stderr and no half-written file; 1 for a run that failed.
int run(int argc, char** argv, const std::string& shows, const std::vector<Option>& options,
        const std::function<void(Frame&)>& body);

/// Same for an experiment without options of its own.
inline int run(int argc, char** argv, const std::string& shows, const std::function<void(Frame&)>& body) {
  return run(argc, argv, shows, {}, body);
}

}  // namespace experiment
