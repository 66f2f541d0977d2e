#pragma once
#include "avi/core/dot.hpp"
#include "avi/core/require.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

/// @file
/// One explicit Runge-Kutta step of any tableau, for an autonomous system z' = F(z), and step-size control
/// for embedded pairs (Hairer, Norsett and Wanner 1993, Section II.4).

namespace avi {

/// @name Tableaus
/// \f$k_i = F(z_0 + h \sum_{j<i} a_{ij} k_j)\f$, \f$z_1 = z_0 + h \sum_i b_i k_i\f$ with \f$i = 1, \ldots,
/// s\f$; the nodes are \f$c_i = \sum_j a_{ij}\f$. For a pair, `embedded` are the weights of the solution of
/// the other order.
/// @{

/// The classical method of order 4 (Kutta 1901).
struct ClassicalRungeKutta {
  static constexpr int stages = 4;  ///< s.
  static constexpr int order = 4;   ///< With the weights b.
  /// a_ij, by rows.
  static constexpr std::array<std::array<double, 4>, 4> a{{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}};
  static constexpr std::array<double, 4> b{1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};  ///< b_i.
};

/// Bogacki and Shampine's pair 3(2) (1989), as in MATLAB's ode23. The last stage is the first one of the next
/// step.
struct BogackiShampine {
  static constexpr int stages = 4;          ///< s.
  static constexpr int order = 3;           ///< With the weights b.
  static constexpr int embedded_order = 2;  ///< With the embedded weights.
  /// a_ij, by rows.
  static constexpr std::array<std::array<double, 4>, 4> a{
      {{}, {1.0 / 2.0}, {0.0, 3.0 / 4.0}, {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0}}};
  static constexpr std::array<double, 4> b{2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0, 0.0};  ///< b_i.
  /// b_i of the solution of order embedded_order.
  static constexpr std::array<double, 4> embedded{7.0 / 24.0, 1.0 / 4.0, 1.0 / 3.0, 1.0 / 8.0};
};

/// Dormand and Prince's pair 5(4) (1980), as in MATLAB's ode45. The last stage is the first one of the next
/// step.
struct DormandPrince {
  static constexpr int stages = 7;          ///< s.
  static constexpr int order = 5;           ///< With the weights b.
  static constexpr int embedded_order = 4;  ///< With the embedded weights.
  /// a_ij, by rows.
  static constexpr std::array<std::array<double, 7>, 7> a{
      {{},
       {1.0 / 5.0},
       {3.0 / 40.0, 9.0 / 40.0},
       {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
       {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
       {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
       {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}}};
  static constexpr std::array<double, 7> b = a[6];  ///< b_i.
  /// b_i of the solution of order embedded_order.
  static constexpr std::array<double, 7> embedded{
      5179.0 / 57600.0, 0.0,       7571.0 / 16695.0, 393.0 / 640.0, -92097.0 / 339200.0,
      187.0 / 2100.0,   1.0 / 40.0};
};
/// @}

/// A Runge-Kutta tableau, such as those above.
template <class T>
concept Tableau = requires {
  T::stages, T::order, T::a, T::b;
};

/// A tableau with the weights of an embedded solution of another order.
template <class T>
concept EmbeddedTableau = Tableau<T> && requires {
  T::embedded_order, T::embedded;
};

/// The stages k_1 ... k_s of one step and its end point, in memory allocated once.
template <Tableau T>
class RungeKuttaStages {
 public:
  /// For systems of `size` equations.
  explicit RungeKuttaStages(Eigen::Index size) : end(size) {
    for (VectorX& stage : k)
      stage.resize(size);
  }

  std::array<VectorX, T::stages> k;  ///< Stages; the caller sets k[0] = F(z).
  VectorX end;                       ///< \f$z + h \sum_i b_i k_i\f$.

  /// Takes a step of size h from z, where k[0] = F(z). `field(z, dz)` is called stages - 1 times.
  template <class Field>
  void advance(Field&& field, const VectorX& z, double h) {
    [&]<std::size_t... i>(std::index_sequence<i...>) { ((combine<i + 1>(z, h), field(end, k[i + 1])), ...); }
    (std::make_index_sequence<T::stages - 1>());
    if constexpr (T::a.back() != T::b) combine<T::stages>(z, h);
  }

 private:
  // Sums with the weights of a stage, or, beyond the last stage, with those of the end point.
  template <std::size_t stage>
  void combine(const VectorX& z, double h) {
    static constexpr auto weights = stage < T::stages ? T::a[stage % T::stages] : T::b;
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      double sum = z[i];
      for (std::size_t j = 0; j < weights.size(); ++j)
        if (weights[j] != 0.0) sum += h * weights[j] * k[j][i];
      end[i] = sum;
    }
  }
};

/// Tolerances for the error of a step, and limits on the ratio of successive step sizes.
struct StepControl {
  double rtol = 1e-3;    ///< Relative tolerance, positive.
  double atol = 1e-6;    ///< Absolute tolerance, positive.
  double safety = 0.9;   ///< Safety factor, in (0, 1).
  double shrink = 0.2;   ///< Smallest ratio of successive step sizes, in (0, 1).
  double grow = 5.0;     ///< Largest ratio of successive step sizes, above 1.
  int rejections = 100;  ///< Limit on rejected trials in one step, at least 1.

  /// Checks the ranges. @throws std::invalid_argument for a value out of range.
  void validate() const {
    require_positive("Relative tolerance", rtol);
    require_positive("Absolute tolerance", atol);
    require(safety > 0.0 && safety < 1.0, "Safety factor", safety, "in (0, 1)");
    require(shrink > 0.0 && shrink < 1.0, "Least step factor", shrink, "in (0, 1)");
    require(std::isfinite(grow) && grow > 1.0, "Largest step factor", grow, "finite and above 1");
    require(rejections >= 1, "Cap on rejected steps", rejections, "at least 1");
  }
};

/// Takes one accepted step from z, where stages.k[0] = F(z), beginning with a trial of size h. On return h is
/// the size to try next, and stages.end is the new point. A step is accepted if the root mean square over all
/// components of (step of T - step of the embedded method) / (atol + rtol |z|) is at most 1, where |z| is the
/// larger magnitude at the two ends. @return the size of the step taken, 0 if the limit on rejections was
/// reached
/// @throws std::invalid_argument for h that is 0 or NaN, and for a control out of range.
template <EmbeddedTableau T, class Field>
double controlled_step(RungeKuttaStages<T>& stages, Field&& field, const VectorX& z, double& h,
                       const StepControl& control) {
  control.validate();
  require(h > 0.0 || h < 0.0, "Step size h", h, "a number other than 0");
  constexpr double exponent = 1.0 / (1.0 + std::min(T::order, T::embedded_order));
  for (int trial = 0; trial <= control.rejections; ++trial) {
    stages.advance(field, z, h);
    double sum = 0.0;
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      double difference = 0.0;
      for (std::size_t j = 0; j < T::b.size(); ++j)
        difference += (T::b[j] - T::embedded[j]) * stages.k[j][i];
      const double scale = control.atol + control.rtol * std::max(std::abs(z[i]), std::abs(stages.end[i]));
      sum += (h * difference / scale) * (h * difference / scale);
    }
    const double error = std::sqrt(sum / static_cast<double>(z.size()));
    double factor = std::isnan(error) ? control.shrink : control.grow;
    if (error > 0.0)
      factor = std::clamp(control.safety * std::pow(error, -exponent), control.shrink, control.grow);
    if (error <= 1.0) {
      // No growth right after a rejection: the estimate there is at its least reliable.
      const double taken = h;
      h *= trial > 0 ? std::min(factor, 1.0) : factor;
      return taken;
    }
    h *= factor;  // below 1, as the error is above it
  }
  return 0.0;
}

}  // namespace avi
