#pragma once
#include "beyond/speed/front_door/contest.hpp"

#include <optional>
#include <vector>

/// @file
/// Who is the first to reach an accuracy.

namespace experiment::front_door {

/// Position errors at the end that are raced for.
inline constexpr double targets[] = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11};

/// How closely a race is measured.
struct Budget {
  double longest_run = 0.005;  ///< Seconds; a family ends with the first setting that takes longer.
  double least_block = 1e-4;   ///< Seconds of a timed block; shorter runs are repeated within it.
  int rounds = 3;              ///< Blocks of each setting, of which the least counts.
  double ratio = 0.1;          ///< Of a tolerance to the one before.
  int refined = 0;             ///< Settings between two, where the first to pass is looked for.
};

/// One family at one setting.
struct Point {
  std::size_t family = 0;
  double setting = 0.0;
  double error = 0.0;
  double seconds = 0.0;  ///< At first of one run, after measure() the least of all blocks.
  long evaluations = 0;  ///< Of the field, or of H.
  long steps = 0;
  bool measured = false;  ///< Its seconds are those of blocks.
};

/// The cheapest settings that reach a target; nullopt where none does.
struct Cell {
  double target = 0.0;
  std::optional<Point> ours, peer;
};

struct Outcome {
  std::vector<Point> points;  ///< Every setting that was tried and came through.
  std::vector<Cell> cells;    ///< One for each target.
};

/// Each family is run from coarse to fine tolerances, and between the last that fails and the
/// first that passes a target in finer parts; then the cheapest three of each side for each target are timed,
/// one after the other in each round, so that a drift of the machine's speed meets all alike.
Outcome race(const Contest& contest, const Budget& budget);

}  // namespace experiment::front_door
