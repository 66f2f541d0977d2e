#pragma once
#include <string>

/// @file
/// Where a data file comes from.

namespace experiment {

std::string commit();    ///< `git describe --always --dirty` of the source folder, or "unknown".
std::string compiler();  ///< Name and version.
std::string machine();   ///< Processor model.
std::string date();      ///< UTC, ISO 8601.

/// Compiler flags of an experiment.
std::string flags(const std::string& experiment);

}  // namespace experiment
