#pragma once
#include "beyond/speed/front_door/contest.hpp"

#include <algorithm>
#include <optional>

// A race: which family is the first to reach an accuracy.

namespace experiment::front_door {

/// Target position errors at the end.
inline constexpr double targets[] = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11};

/// Accuracy of the measurements in a race.
struct Budget {
  /// Seconds; the scan of a family ends with the first setting that takes longer (ours: four times as long).
  double longest_run = 0.005;
  double least_block = 1e-4;  ///< Seconds of a timed block; shorter runs are repeated within it.
  int rounds = 3;             ///< Timed blocks for each setting, of which the fastest counts.
  double ratio = 0.1;         ///< Ratio of each tolerance to the one before.
  int refined = 0;            ///< Settings tried between the last to fail and the first to pass a target.
};

/// The result of one family at one setting.
struct Point {
  std::size_t family = 0;
  double setting = 0.0;
  double error = 0.0;
  double seconds = 0.0;  ///< Initially of one run; after measure(), of the fastest block.
  long evaluations = 0;  ///< Evaluations of the field, or of H.
  long steps = 0;
  bool measured = false;  ///< The seconds are those of timed blocks.
};

/// The cheapest settings that reach a target; nullopt if there is none.
struct Cell {
  double target = 0.0;
  std::optional<Point> ours, peer;
};

struct Outcome {
  std::vector<Point> points;  ///< All settings that were tried; the error is infinite where a run failed.
  std::vector<Cell> cells;    ///< One cell per target.
};

inline constexpr double finest_target = targets[std::size(targets) - 1];

/// Runs each family from coarse to fine tolerances, with finer settings between the last to fail and the
/// first to pass a target. For each target and side, the three cheapest settings are then timed, one after
/// the other in each round, so that a change of the machine's speed affects all of them.
class Race {
 public:
  Race(const Contest& contest, const Budget& budget) : contest_(contest), budget_(budget) {}

  Outcome result() {
    for (std::size_t i = 0; i < contest_.families.size(); ++i)
      scan(i);
    measure();
    Outcome outcome{points_, {}};
    for (const double target : targets)
      outcome.cells.push_back({target, best(true, target), best(false, target)});
    return outcome;
  }

 private:
  static bool is_ours(std::size_t family) { return family == 0; }

  /// One run; a short one is repeated twice, and the least time counts.
  Point tried(std::size_t family, double setting) {
    const auto run = [&] {
      return contest_.families[family].run({.setting = setting, .step_cap = step_cap_});
    };
    Result result = run();
    if (result.seconds < 1e-3)
      for (int again = 0; again < 2; ++again)
        result.seconds = std::min(result.seconds, run().seconds);
    const double error = result.ok ? contest_.position_error(0, result.t, result.q) : HUGE_VAL;
    if (!is_ours(family) && error <= finest_target) needed_ = std::min(needed_, result.seconds);
    return points_.emplace_back(Point{family, setting, std::isnan(error) ? HUGE_VAL : error, result.seconds,
                                      result.evaluations, result.steps});
  }

  void scan(std::size_t family) {
    const bool ours = is_ours(family);
    const double finest = ours ? 1e-13 : 1e-15;
    std::vector<double> passed(std::size(targets), 0.0);  // the first setting that passes
    double previous = 0.0, least = HUGE_VAL;
    int stale = 0;
    step_cap_ = 300'000;
    for (double setting = 1e-2; setting > 0.7 * finest; previous = setting, setting *= budget_.ratio) {
      const Point point = tried(family, setting);
      for (std::size_t i = 0; i < std::size(targets); ++i)
        if (passed[i] == 0.0 && point.error <= targets[i]) {
          passed[i] = setting;
          if (previous > 0.0 && (i == 0 || passed[i - 1] != setting)) refine(family, previous, setting);
        }
      if (point.error <= 0.5 * finest_target) break;
      if (point.seconds > budget_.longest_run * (ours ? 4.0 : 1.0)) break;
      if (!ours && point.seconds > 3.0 * needed_) break;  // the finest target was met in a third of this
      // the library fails at tolerances that are too small for it
      if (!ours && least < 1e-3 && !(point.error < 1e3 * least)) break;
      if (setting < 1e-8 && least > 0.1) break;  // chaos
      stale = point.error < 0.7 * least ? 0 : stale + 1;
      if (least = std::min(least, point.error); !ours && least < 1e-3 && stale >= 5) break;  // rounding
      step_cap_ = std::min(300'000L, 4 * point.steps + 1000);
    }
  }

  /// Tries the settings between two.
  void refine(std::size_t family, double coarse, double fine) {
    for (int k = 1; k <= budget_.refined; ++k)
      tried(family, coarse * std::pow(fine / coarse, k / (budget_.refined + 1.0)));
  }

  /// The three settings that are cheapest, by the first times, among those that reach a target.
  std::vector<std::size_t> cheapest(bool ours, double target) const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_ours(points_[i].family) == ours && points_[i].error <= target) list.push_back(i);
    std::ranges::sort(list, {}, [&](std::size_t i) { return points_[i].seconds; });
    if (list.size() > 3) list.resize(3);
    return list;
  }

  void measure() {
    std::vector<std::size_t> chosen;
    for (const double target : targets)
      for (const auto& list : {cheapest(true, target), cheapest(false, target)})
        chosen.insert(chosen.end(), list.begin(), list.end());
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (int round = 0; round < budget_.rounds; ++round)
      for (const std::size_t i : chosen) {
        Point& point = points_[i];
        const int repeats = static_cast<int>(std::clamp(budget_.least_block / point.seconds, 1.0, 1e4));
        const double seconds =
            contest_.families[point.family].run({.setting = point.setting, .repeats = repeats}).seconds;
        point.seconds = point.measured ? std::min(point.seconds, seconds) : seconds;
        point.measured = true;
      }
  }

  std::optional<Point> best(bool ours, double target) const {
    const Point* found = nullptr;
    for (const Point& point : points_)
      if (point.measured && is_ours(point.family) == ours && point.error <= target &&
          (!found || point.seconds < found->seconds))
        found = &point;
    return found ? std::optional(*found) : std::nullopt;
  }

  const Contest& contest_;
  const Budget& budget_;
  std::vector<Point> points_;
  double needed_ = HUGE_VAL;  // least seconds of another library for the last target
  long step_cap_ = 0;
};

}  // namespace experiment::front_door
