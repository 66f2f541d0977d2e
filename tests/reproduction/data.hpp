#pragma once
#include "scorecard/results.hpp"

/// @file
/// What the experiments wrote for the tests that ask for it.

namespace data {

inline const scorecard::Results whole({AVI_CHECK_DIR "/data"});   ///< Of whole runs.
inline const scorecard::Results quick({AVI_CHECK_DIR "/quick"});  ///< Of shortened ones.

}  // namespace data
