#pragma once
#include "src/core/lowest.hpp"

#include <functional>
#include <vector>

/// @file
/// The search for zeros of a function between its samples.

namespace avi::detail {

/// A sample: the value of a function at a part of the step.
struct Sample {
  double part;         ///< Part of the step, in [0, 1].
  double g;            ///< Value of the function.
  bool exact = false;  ///< Whether it was taken at a state of the method, not of its polynomial.
  bool turns = false;  ///< Whether the function turns before the next sample.
};

/// The search for zeros that samples do not show: two where a function turns on the other side of zero, or
/// three that look like one. The slopes at both ends of an interval tell whether it may turn; if so, its
/// lowest point is looked for. Near zero, the polynomial of a step, which has half as many digits as the ends
/// of the step, is corrected by steps of the method.
class Dips {
 public:
  using Function = std::function<double(double)>;  ///< Function that gives g at a part of the step.

  /// Takes the function. @param on its value by the polynomial @param exact its value by steps of the method,
  /// nan if they fail @param end end of the last interval @param noise rounding error of the function
  /// @param evaluations approximate number of evaluations of `on` that may be made
  Dips(Function on, Function exact, double end, double noise, int evaluations)
      : on_(std::move(on)), exact_(std::move(exact)), end_(end), noise_(noise), left_(evaluations) {}

  /// Returns true if there may be zeros between the samples k and k + 1 that those do not show.
  static bool may_hide(const std::vector<Sample>& samples, std::size_t k);
  /// Returns true if the sample k, between two of one sign, is so small that the polynomial may be wrong
  /// there.
  static bool grazes(const std::vector<Sample>& samples, std::size_t k);

  /// Adds samples that show the zeros between two samples, in any order.
  void look(const Sample& a, const Sample& b, std::vector<Sample>& more);

 private:
  struct Point {
    double x, g, slope;
  };
  void look_low(const Sample& a, const Sample& b, std::vector<Sample>& more);
  double on(double x) { return --left_, on_(x); }
  Point point(double x, double g, double delta);
  void split(const Point& a, const Point& b, int depth, bool trusted, std::vector<Sample>& more);
  void touch(const Sample& a, const Sample& b, const Lowest& there, double sign, std::vector<Sample>& more);

  Function on_, exact_;
  double end_, noise_;
  double aside_ = 0.0;  // part of an interval over which a slope is taken
  int left_;
};

}  // namespace avi::detail
