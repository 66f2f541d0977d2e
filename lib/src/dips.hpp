#pragma once
#include <functional>
#include <vector>

/// @file
/// Zeros of a function between its samples.

namespace avi::detail {

/// The value of a function somewhere in a step.
struct Sample {
  double part;         ///< Part of the step, in [0, 1].
  double g;            ///< Value there.
  bool exact = false;  ///< Taken at a state of the method, not of its polynomial.
  bool turns = false;  ///< The function turns before the next one.
};

/// Looks for zeros in between where samples do not show them: two where a function turns on the other side of
/// zero, three where they seem to be one. The slopes at both ends of an interval say whether it may turn; the
/// lowest point is looked for where it does. Near zero the polynomial of a step, which has half of the digits
/// of its ends, is corrected by steps of the method.
class Dips {
 public:
  using Function = std::function<double(double)>;  ///< g at a part of the step.

  /// @param on by the polynomial @param exact by steps of the method, or nan @param end of the last interval
  /// @param noise of the function @param evaluations of `on`
  /// that it may take, about
  Dips(Function on, Function exact, double end, double noise, int evaluations)
      : on_(std::move(on)), exact_(std::move(exact)), end_(end), noise_(noise), left_(evaluations) {}

  /// There may be zeros between the samples k and k + 1 that those do not show.
  static bool may_hide(const std::vector<Sample>& samples, std::size_t k);
  /// The sample k is so small between two of one sign that the polynomial may err.
  static bool grazes(const std::vector<Sample>& samples, std::size_t k);

  /// Adds what shows the zeros between two samples, in any order.
  void look(const Sample& a, const Sample& b, std::vector<Sample>& more);

 private:
  struct Point {
    double x, g, slope;
  };
  struct Lowest {
    double x, f;
  };
  void look_low(const Sample& a, const Sample& b, std::vector<Sample>& more);
  double on(double x) { return --left_, on_(x); }
  Point point(double x, double g, double delta);
  void split(const Point& a, const Point& b, int depth, bool trusted, std::vector<Sample>& more);
  void touch(const Sample& a, const Sample& b, const Lowest& there, double sign, std::vector<Sample>& more);

  Function on_, exact_;
  double end_, noise_;
  double aside_ = 0.0;  // part of an interval from which a slope is taken
  int left_;
};

}  // namespace avi::detail
