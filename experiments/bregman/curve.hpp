#pragma once
#include "avi/optim/objective.hpp"
#include "common/table.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// f along a run, thinned for a figure.

namespace experiment {

/// Witness that gathers f over the iterations in bins of equal width, on a linear or a logarithmic axis: of
/// each bin its last iterate, the least and largest f in it, so that oscillations faster than the bins stay
/// visible, and the largest f from the bin to the end of the run: their upper envelope, but for the last
/// twentieth of the iterations, where too little of the run is left for its oscillation to be seen.
class Curve {
 public:
  /// Iterations a bin spans: at least `width`, and at least the fraction `growth` of the iterations so far.
  explicit Curve(double width, double growth = 0.0) : width_(width), growth_(growth) {}

  void operator()(const avi::Iterate& at, long k, long gradients) {
    if (points_.empty() || k >= next_) {
      points_.push_back({});
      next_ = k + std::max(width_, growth_ * k);
    }
    Point& bin = points_.back();
    bin.iteration = k;
    bin.gradients = gradients;
    bin.value = at.value;
    bin.least = std::min(bin.least, at.value);
    bin.most = std::max(bin.most, at.value);
  }

  /// The meaning of a row, for the table's head.
  static constexpr const char* rows =
      "f at the end of each bin of iterations, its least and largest value in the bin, its largest from "
      "there on; envelope: the same without the last twentieth of the iterations";

  /// The caller's columns and those that append() fills.
  static std::vector<std::string> columns_after(std::vector<std::string> columns) {
    columns.insert(columns.end(),
                   {"iteration", "gradient_evaluations", "value", "least", "most", "ahead", "envelope"});
    return columns;
  }

  /// Adds one row for each bin, each beginning with the caller's cells.
  void append(Table& table, const std::vector<std::string>& begin) const {
    std::vector<double> ahead(points_.size());
    double largest = 0.0;
    for (std::size_t i = points_.size(); i-- > 0;)
      ahead[i] = largest = std::max(largest, points_[i].most);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Point& bin = points_[i];
      auto cells = begin;
      for (const auto& cell :
           {std::to_string(bin.iteration), std::to_string(bin.gradients), exact(bin.value), exact(bin.least),
            exact(bin.most), exact(ahead[i]),
            exact(20 * bin.iteration <= 19 * points_.back().iteration ? ahead[i] : std::nan(""))})
        cells.push_back(cell);
      table.add(std::move(cells));
    }
  }

 private:
  struct Point {
    long iteration = 0, gradients = 0;
    double value = 0.0;
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
  };

  double width_, growth_, next_ = 0.0;
  std::vector<Point> points_;
};

}  // namespace experiment
