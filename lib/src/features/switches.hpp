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
/// The switches of H: times at which it changes to another formula.

namespace avi::detail {

/// The times at which H, of (q, t, p) with time as the last coordinate, switches. There a comparison of two
/// functions of time alone becomes true or false; or such a function, of which H takes the absolute value or
/// the sign, goes through zero; or one of which H takes the floor goes through a whole number. Steps end
/// there, so that H is smooth within each step. The momentum of time makes up for the change of H, which
/// keeps \f$H + p^t\f$ constant.
///
/// Time is divided into cells. In each, zeros are looked for by bisection, until the Taylor series of such a
/// function about the middle of an interval shows that it has none there, or one at most. The cells depend
/// only on H and on the times of start and end, so all runs along an orbit meet the same switches, to the
/// last bit. Copies can be used side by side.
class Switches {
 public:
  /// The switches of H, a node of a graph, in a run from one time to another. @return null where there are
  /// none
  static std::shared_ptr<const Switches> of(const ExpressionGraph& graph, int energy, double from, double to);

  /// A function of time that makes H switch.
  struct Cause {
    int node = -1;       ///< Node of the function: H switches where it becomes negative, or no longer is.
    int bends = -1;      ///< Node of a function with a zero for each switch.
    bool whole = false;  ///< Whether H switches where the floor of the function changes.
    bool operator==(const Cause&) const = default;
  };
  /// The Taylor series of a cause, with the arguments of functions in it that are flat where their argument
  /// is large. The coefficients of the cause, then those of the arguments, are at `places`. `falls` says for
  /// each argument whether it has to be negative for its function to be flat.
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
  /// The first switch at t or beyond it, in the direction from t to `to`, if it is not beyond `to`.
  std::optional<Switch> next(double t, double to);

  /// The switch at t, or so near behind t that no step leads there. @param sense 1, or -1 in a run backwards
  std::optional<Switch> at(double t, double sense);

  /// Returns true if a time is so near a switch that H may be that of neither side.
  bool is_near(double t) { return next(t - 64.0 * rounding(t), t + 64.0 * rounding(t)).has_value(); }

  /// The decrease of H over a switch, for the system at (q, p), n numbers each.
  double fall(const double* q, const double* p, const Switch& at);

 private:
  Switches(const ExpressionGraph& graph, int energy, std::vector<Cause> causes, double from, double cell);
  // A run begins inside a cell, as there may be a switch at its start.
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
    bool known;  // whether what follows is right
    double least, most;
    bool monotone;
  };
  Outlook outlook(std::size_t cause, double t, double distance);
  void search(std::size_t cause, const Point& low, const Point& high);
  void look_into(double cell);

  static constexpr int most_looks = 100'000;  // in a cell, or for one switch: about a tenth of a second

  Eigen::Index n_;
  double from_, cell_;
  std::vector<Cause> causes_;
  RecordedFormula<double> compared_, energy_;
  std::vector<double> at_;      // (q, p), zero except for time
  double seen_;                 // number of the cell whose switches are known
  std::vector<Switch> inside_;  // switches of that cell, forwards in time
  std::vector<Expansion> expansions_;
  int looks_ = 0;  // looks that this cell took
};

}  // namespace avi::detail
