#pragma once
#include <string>

/// @file
/// Where a data file comes from.

namespace experiment {

std::string commit();    ///< `git describe --always --dirty` of the source folder, or "unknown".
std::string compiler();  ///< Name and version.
std::string flags();     ///< Compiler flags of the experiments.
std::string machine();   ///< Processor model.
std::string date();      ///< UTC, ISO 8601.

}  // namespace experiment
