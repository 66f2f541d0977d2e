#pragma once
#include "beyond/speed/front_door/contest.hpp"

#include <functional>
#include <string>
#include <vector>

/// @file
/// The problems of the race.

namespace experiment::front_door {

/// A problem with its characteristic time: a period, or 2 pi over the usual frequency.
struct Scene {
  std::string name;
  std::string kind;
  bool held_out;                 ///< Drawn up after the menu was made; run by `--all` and `--full` only.
  double unit;                   ///< Characteristic time.
  std::vector<double> horizons;  ///< In characteristic times; where motion is regular enough for a reference.
  std::function<Contest(double span)> make;
};

/// All of them, in the order in which they are shown.
std::vector<Scene> scenes();

}  // namespace experiment::front_door
