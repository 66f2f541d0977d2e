#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

// Wall-clock times of runs that are compared with each other.

namespace experiment {

/// A stopwatch: wall-clock time in seconds since its construction.
class Stopwatch {
 public:
  double operator()() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

/// Wall-clock time of one call, in seconds.
double seconds(auto&& work) {
  const Stopwatch elapsed;
  work();
  return elapsed();
}

/// Median of a list (the lower one for an even count).
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The least time of each piece of work, in seconds: that of the least disturbed run. Each of the `rounds`
/// runs all pieces in turn, short ones up to 64 times in a row, so that a change of the machine's speed
/// affects all of them.
inline std::vector<double> interleaved_least_seconds(const std::vector<std::function<void()>>& works,
                                                     int rounds) {
  std::vector<int> repeats;
  for (const auto& work : works)
    repeats.push_back(static_cast<int>(std::clamp(2e-3 / std::max(seconds(work), 1e-9), 1.0, 64.0)));
  std::vector<double> least(works.size(), HUGE_VAL);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < works.size(); ++i)
      least[i] = std::min(least[i], seconds([&] {
                                      for (int k = 0; k < repeats[i]; ++k)
                                        works[i]();
                                    }) / repeats[i]);
  return least;
}

}  // namespace experiment
