#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/autodiff/program.hpp"
#include "avi/core/state.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

/// @file
/// Where H switches with time.

namespace avi::detail {

/// The times at which H, of (q, t, p) with time as the last coordinate, switches: at which a comparison of
/// two functions of time alone becomes true or false, or such a function whose absolute value H takes goes
/// through zero. A step ends there, so that H is smooth in every one, and the momentum of time changes by
/// what H does, which keeps \f$H + p^t\f$ as it is.
///
/// Time is divided into cells in which those functions bend a few times at most, as the Taylor series of them
/// at many points tell; in a cell changes of sign are looked for between 9 points, and where a function
/// comes near zero between them. Which cells there are depends on H and the run alone: so all runs along an
/// orbit meet the same switches, to the last bit. A copy may work beside the others.
class Switches {
 public:
  /// Of H as a node of a graph, in a run from one time to another. @return null where there are none
  static std::shared_ptr<const Switches> of(const ExpressionGraph& graph, int energy, double from, double to);

  /// For each node up to that of H, whether it is a function of the last coordinate alone.
  static std::vector<char> of_time_alone(const ExpressionGraph& graph, int energy);

  /// A switch: the last time before it and the first one behind it, in the direction of the run.
  struct Switch {
    double before, after;
  };
  /// The first one at t or behind it in the direction from t to `to`, if it is not beyond that.
  std::optional<Switch> next(double t, double to);

  /// The one at t, or so near behind it that no step leads there. @param sense 1, or -1 in a run backwards
  std::optional<Switch> at(double t, double sense);

  /// How much H falls at a switch where the system is there; (q, p) of n numbers each.
  double fall(const double* q, const double* p, const Switch& at);

 private:
  Switches(const ExpressionGraph& graph, int energy, const std::vector<int>& differences, double from,
           double cell);
  [[nodiscard]] double edge(double cell) const { return from_ + cell * cell_; }
  struct Point {
    double t, value;
  };
  double value(std::size_t difference, double t);
  double lowest(std::size_t difference, double sign, double low, double high);
  void add_zero(std::size_t difference, const Point& low, const Point& high);
  void look_into(double cell);

  static constexpr std::size_t parts = 8;     // of a cell
  static constexpr int most_cells = 100'000;  // in which one switch is looked for: some ten milliseconds

  Eigen::Index n_;
  double from_, cell_;
  RecordedFormula<double> differences_, energy_;
  std::vector<double> at_;                            // (q, p), all but time zero
  double seen_;                                       // cell that is known
  std::vector<Switch> inside_;                        // its switches, forwards
  std::vector<std::array<Point, parts + 3>> points_;  // scratch: of each difference
};

}  // namespace avi::detail
