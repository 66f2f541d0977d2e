#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/autodiff/program.hpp"
#include "avi/autodiff/taylor_series.hpp"
#include "avi/core/state.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

/// @file
/// Where H switches with time.

namespace avi::detail {

/// The times at which H, of (q, t, p) with time as the last coordinate, switches: at which a comparison of
/// two functions of time alone becomes true or false, or such a function goes through zero whose absolute
/// value H takes, or through a whole number where H takes its floor. A step ends there, so that H is smooth
/// in every one, and the momentum of time changes by what H does, which keeps \f$H + p^t\f$ as it is.
///
/// Time is divided into cells, in which zeros are looked for by halves until the Taylor series of such a
/// function in the middle of a half tells that it has none there, or one at most. Which cells there are
/// depends on H and the run alone: so all runs along an orbit meet the same switches, to the last bit. A copy
/// may work beside the others.
class Switches {
 public:
  /// The switches of H, a node of a graph, in a run from one time to another. @return null where there are
  /// none
  static std::shared_ptr<const Switches> of(const ExpressionGraph& graph, int energy, double from, double to);

  /// A function of time that makes H switch.
  struct Cause {
    int node = -1;       ///< It itself: H switches where it becomes negative, or no longer is.
    int bends = -1;      ///< Node of a function with a zero for each switch.
    bool whole = false;  ///< H switches where its floor changes.
    bool operator==(const Cause&) const = default;
  };
  /// The series of a cause, where in it the coefficients are: of the cause, and of arguments of functions
  /// that are flat where the argument is large; and for each of these whether it has to be negative.
  struct Expansion {
    TaylorSeries<DualNumber<1>> series;
    std::vector<int> places;
    std::vector<char> falls;
  };
  static constexpr int order = 8;  ///< Order of the series.
  /// A switch: the last time before it and the first one behind it, in the direction of the run.
  struct Switch {
    double before, after;
  };
  /// The first one at t or behind it in the direction from t to `to`, if it is not beyond that.
  std::optional<Switch> next(double t, double to);

  /// The one at t, or so near behind it that no step leads there. @param sense 1, or -1 in a run backwards
  std::optional<Switch> at(double t, double sense);

  /// A time is so near one that H may be that of neither side.
  bool is_near(double t) { return next(t - 64.0 * rounding(t), t + 64.0 * rounding(t)).has_value(); }

  /// How much H falls at a switch where the system is there; (q, p) of n numbers each.
  double fall(const double* q, const double* p, const Switch& at);

 private:
  Switches(const ExpressionGraph& graph, int energy, std::vector<Cause> causes, double from, double cell);
  // A run begins in the middle of a cell: there may be a switch at its start.
  [[nodiscard]] double edge(double cell) const { return from_ + (cell - 0.381966) * cell_; }
  [[nodiscard]] double rounding(double t) const {
    return std::numeric_limits<double>::epsilon() * std::max(std::abs(t), cell_);
  }
  struct Point {
    double t, value;
  };
  double value(std::size_t cause, double t);
  void add_between(std::size_t cause, const Point& low, const Point& high);
  void add_zero(std::size_t cause, double bound, const Point& low, const Point& high);
  struct Outlook {
    bool known;  // what follows is right
    double least, most;
    bool monotone;
  };
  Outlook outlook(std::size_t cause, double t, double distance);
  void search(std::size_t cause, const Point& low, const Point& high);
  void look_into(double cell);

  static constexpr int most_looks = 100'000;  // in a cell, or for one switch: some tenth of a second

  Eigen::Index n_;
  double from_, cell_;
  std::vector<Cause> causes_;
  RecordedFormula<double> compared_, energy_;
  std::vector<double> at_;      // (q, p), all but time zero
  double seen_;                 // cell that is known
  std::vector<Switch> inside_;  // its switches, forwards
  std::vector<Expansion> expansions_;
  int looks_ = 0;  // that it took
};

}  // namespace avi::detail
