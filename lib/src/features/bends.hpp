#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "src/autodiff/factor.hpp"
#include "src/choice/sketch.hpp"

#include <algorithm>
#include <vector>

/// @file
/// Places where H is smooth but bends within a short length, read from its formula.

namespace avi::detail {

/// The functions u of (q, p), time among q, near whose zeros H changes its form: those of which H takes a
/// root, another fractional power or the logarithm, or by which it divides, if these never vanish; and the
/// arguments of functions that change their form near 0, such as exp and tanh. The length
/// \f$s_k\f$ is \f$|u_k|^{1/d_k}\f$ or \f$(1 + u_k^2)^{1/2d_k}\f$, where \f$d_k\f$ is the degree of
/// \f$u_k\f$. The complex zeros of these lengths are singularities of H, or near such. So a step of a method
/// of high order may be as long as the orbit takes to move by \f$s_k\f$, and the frequency \f$\phi_k =
/// w_k / s_k\f$ with the largest speed \f$w_k\f$ of \f$s_k\f$ belongs to the rate of the monitor `poles`.
class Bends {
 public:
  /// Finds the bends of H, a node of a graph of (q, p). If there are more than `most`, none is taken.
  /// @param timed whether the last coordinate is time
  Bends(const ExpressionGraph& graph, int energy, bool timed);

  /// Returns true if there are none.
  [[nodiscard]] bool none() const { return bends_.empty(); }
  /// Number of bends.
  [[nodiscard]] std::size_t size() const { return bends_.size(); }
  /// Takes the speeds \f$w_k\f$, the largest along a sketch, or 0 where \f$s_k\f$ changes by less than a
  /// factor of four, as far from a bend, and for poles.
  void measure(const Sketch& sketch);
  /// Takes the speeds of the bends that depend on time alone from the whole run. @param start (q, p), where
  /// time is the last coordinate
  void look_ahead(const VectorX& start, double t_end);
  /// The highest frequency \f$w_k / s_k\f$ found by that.
  [[nodiscard]] double ahead() const { return ahead_; }
  /// Takes no bend from here on.
  void forget();
  /// Returns true if a sketch, the one measured, shows less of some bends than there is. Poles among them are
  /// taken for bends from then on.
  bool take_missed(const Sketch& sketch);
  /// The speeds \f$w_k\f$.
  [[nodiscard]] const std::vector<double>& speeds() const { return speeds_; }
  /// Returns true if one of them is not 0.
  [[nodiscard]] bool matter() const {
    return std::ranges::any_of(speeds_, [](double speed) { return speed > 0.0; });
  }
  /// Returns true if this node is a pole that is taken for a bend.
  [[nodiscard]] bool takes(int node) const {
    for (std::size_t k = 0; k < size(); ++k)
      if (bends_[k].node == node && !bends_[k].beside) return speeds_[k] > 0.0;
    return false;
  }
  /// The time from a point (q, p) to the nearest bend, \f$\min_k s_k / w_k\f$.
  double time_to_nearest(const double* z);
  /// Adds the node of \f$\sum_k w_k / s_k\f$ to a graph that contains H as the one of the constructor does.
  /// @param speeds \f$w_k\f$, those of which are 0 are left out
  Factor frequency(ExpressionGraph& graph, const double* speeds) const;

  static constexpr std::size_t most = 64;  ///< Largest number of bends of one H.

 private:
  struct Bend {
    int node;            // u
    double degree;       // d
    bool beside;         // whether the singularities are at u = +-i, not at u = 0
    bool is_pole;        // whether H divides by u, a function of coordinates alone that never vanishes
    bool of_time;        // whether u depends on time alone
    bool may_vanish;     // whether the formula does not show that u is positive; only where of_time
    double shortest;     // least value of s, as far as the formula shows
    double speed = 0.0;  // largest speed of s on the sketch
  };
  void find(int energy, bool timed);
  /// Returns false for a bend of so small a part of the way that rounding would decide.
  static bool is_resolved(double shortest, double way) { return shortest > 1e-11 * way; }
  /// s of bend k at a sample.
  [[nodiscard]] double length(std::size_t sample, std::size_t k) const { return along_[sample * size() + k]; }
  /// Its mean speed in the step from there.
  [[nodiscard]] double speed(const Sketch& sketch, std::size_t sample, std::size_t k) const {
    return std::abs(length(sample + 1, k) - length(sample, k)) / sketch.samples[sample].h;
  }
  bool is_missed(const Sketch& sketch, std::size_t k, double fastest);
  [[nodiscard]] double length_of(std::size_t k, double u) const;
  void look_at(const double* z);
  [[nodiscard]] Factor length(ExpressionGraph& graph, const Bend& bend) const;

  const ExpressionGraph* graph_;
  std::vector<Bend> bends_;
  std::vector<double> speeds_, lengths_;  // w, and s at the last point
  std::vector<double> along_;             // s at the samples
  double ahead_ = 0.0;                    // largest w / s of a bend in time
  std::vector<int> needed_;               // nodes of which the u are made, in order
  std::vector<double> values_;            // of these
};

}  // namespace avi::detail
