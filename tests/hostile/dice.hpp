#pragma once
#include <cmath>
#include <cstdint>

/// @file
/// Random numbers that are the same with every standard library; compilers may ask for them in another order.

namespace hostile {

/// SplitMix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, 2014).
class Dice {
 public:
  /// The sequence that belongs to a seed and a number.
  Dice(std::uint64_t seed, std::uint64_t index) : state_(seed * 0x9e3779b97f4a7c15U + (index << 20U)) {
    for (int i = 0; i < 4; ++i)
      next();
  }
  /// Even between two bounds.
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11U) * 0x1p-53;
  }
  /// Even in the logarithm.
  double decades(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  /// A whole number, both bounds included.
  int whole(int low, int high) {
    return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// True with this probability.
  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  /// 1 or -1.
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::uint64_t next() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }
  std::uint64_t state_;
};

}  // namespace hostile
