#pragma once
#include "avi/autodiff/partials.hpp"
#include "avi/autodiff/recording.hpp"
#include "avi/core/dot.hpp"
#include "avi/core/state.hpp"
#include "src/features/barriers.hpp"
#include "src/features/switches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

/// @file
/// The vector field of H at one point at a time, and what else one point shows.

namespace avi::detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();  ///< Infinity, or unknown.

/// (q, p) as one vector.
inline VectorX stacked(const State<dynamic>& z) { return (VectorX(2 * z.q.size()) << z.q, z.p).finished(); }

/// The Hamiltonian vector field of H, evaluated at one point at a time.
class PointField {
 public:
  /// Makes the field of H, a node of a graph of (q, p). @param supplied nodes of its gradient, if H supplies
  /// its own
  PointField(const ExpressionGraph& graph, int energy, const std::vector<int>& supplied)
      : recording_(std::make_shared<const Recording>(graph, energy, energy, supplied)),
        n_(recording_->inputs() / 2), formula_{recording_->value_and_gradient()} {}

  /// Sets dz = J grad H at z = (q, p). @return H
  double operator()(const VectorX& z, VectorX& dz) { return (*this)(z.data(), z.data() + n_, dz); }
  /// Evaluates the field at a state.
  double operator()(const State<dynamic>& z, VectorX& dz) { return (*this)(z.q.data(), z.p.data(), dz); }
  /// Evaluates the field at q and p, n entries each.
  double operator()(const double* q, const double* p, VectorX& dz) {
    formula_.run(q, p, n_);
    for (int i = 0; i < n_; ++i) {
      dz[i] = sense * formula_.partial(n_ + i);
      dz[n_ + i] = -sense * formula_.partial(i);
    }
    return formula_.value();
  }
  /// Value of H.
  double energy(const double* q, const double* p) {
    // Making a program of H alone takes as long as some evaluations of H with its gradient.
    if (!value_ && ++energies_ > 40) value_.emplace(RecordedFormula<double>{recording_->value()});
    RecordedFormula<double>& formula = value_ ? *value_ : formula_;
    formula.run(q, p, n_);
    return formula.value();
  }
  /// Estimates the diagonal of H_pp at z by two probes with random signs: exact where H_pp is diagonal, else
  /// approximate. Entries that are not positive are replaced by the largest one.
  VectorX metric(const VectorX& z) {
    Duals room(formula_.program);
    VectorX metric = VectorX::Zero(n_), v = VectorX::Zero(2 * n_), w(2 * n_);
    unsigned bits = 12345u;
    for (int probe = 0; probe < 2; ++probe) {
      for (int i = 0; i < n_; ++i)
        v[n_ + i] = sign(bits);
      linear(room, z, v, w);
      for (int i = 0; i < n_; ++i)
        metric[i] = std::max(metric[i], v[n_ + i] * w[i]);
    }
    double largest = 0.0;
    for (int i = 0; i < n_; ++i)
      if (std::isfinite(metric[i])) largest = std::max(largest, metric[i]);
    for (int i = 0; i < n_; ++i)
      if (!(metric[i] > 0.0) || !std::isfinite(metric[i])) metric[i] = largest > 0.0 ? largest : 1.0;
    return metric;
  }
  /// Estimates the largest frequency of small oscillations about z, by power iteration on the linearised
  /// field. The result is a little low; it is 0 where it would not be finite. @param metric diagonal of H_pp
  double fastest(const VectorX& z, const VectorX& metric) {
    Duals room(formula_.program);
    VectorX root = metric, scaled(2 * n_);
    for (double& each : root)
      each = std::sqrt(each);
    const auto size = [&](const VectorX& v) {
      scaled << v.head(n_).cwiseQuotient(root), v.tail(n_).cwiseProduct(root);
      return norm(scaled);
    };
    VectorX v(2 * n_), w(2 * n_);
    unsigned bits = 6789u;
    for (int i = 0; i < n_; ++i)
      v[i] = sign(bits) * root[i], v[n_ + i] = sign(bits) / root[i];
    double square = 0.0;
    for (int k = 0; k < 8; ++k) {
      const double before = size(v);
      linear(room, z, v, w);
      linear(room, z, w, v);
      square = size(v) / before;
      if (!std::isfinite(square) || !(square > 0.0)) return 0.0;
      v /= size(v);
    }
    return std::sqrt(square);
  }
  /// The largest frequency of coordinates that move, but are pushed by no force at z, as in the middle of a
  /// well; 0 if there are none. It is found from the second time derivative of their momenta. @param dz the
  /// slope at z
  double frequency_of_unpushed(const VectorX& z, const VectorX& dz, const VectorX& metric) {
    const auto unpushed = [&](Eigen::Index i) { return dz[n_ + i] == 0.0 && dz[i] != 0.0; };
    double square = 0.0;
    VectorX change;
    for (Eigen::Index i = 0; i < n_ - (timed ? 1 : 0); ++i)
      if (unpushed(i)) {
        if (change.size() == 0) {
          Duals room(formula_.program);
          change.resize(2 * n_);
          linear(room, z, dz, change);
        }
        square = std::max(square, std::abs(change[n_ + i] / dz[i]) * metric[i]);
      }
    return std::isfinite(square) ? std::sqrt(square) : 0.0;
  }
  /// The largest rate at which an entry of the slope changes with time alone, relative to that entry. It is
  /// large near a singularity of coefficients in time. @param dz the slope at z @return 0 where it is not
  /// finite, or H does not depend on time
  double rate_in_time(const VectorX& z, const VectorX& dz) {
    if (!timed) return 0.0;
    Duals room(formula_.program);
    VectorX along = VectorX::Zero(2 * n_), change(2 * n_);
    along[n_ - 1] = 1.0;
    linear(room, z, along, change);
    double rate = 0.0;
    for (int i = 0; i < n_ - 1; ++i)
      for (const int k : {i, n_ + i})
        if (dz[k] != 0.0) rate = std::max(rate, std::abs(change[k] / dz[k]));
    return std::isfinite(rate) ? rate : 0.0;
  }
  /// Raises `most` to the change of the slope at z per relative error of the entries of z, to first order.
  /// @param slope that at z @param draw seed for the signs of those errors
  void add_sensitivity(const Eigen::Map<const VectorX>& z, const Eigen::Map<const VectorX>& slope,
                       unsigned draw, VectorX& most) {
    constexpr double error = 1e-7;
    moved_ = z, there_.resize(z.size());
    for (double& entry : moved_)
      entry *= 1.0 + sign(draw) * error;
    (*this)(moved_, there_);
    most = most.cwiseMax((there_ - slope).cwiseAbs() / error);
  }
  [[nodiscard]] int size() const { return n_; }  ///< Number of degrees of freedom.
  /// Number of operations of H with its gradient.
  [[nodiscard]] double operations() const { return static_cast<double>(formula_.program.operations()); }
  /// The recording of H.
  [[nodiscard]] const std::shared_ptr<const Recording>& recording() const { return recording_; }

  /// Returns true if a place where H is infinite lies between two points, see Barriers.
  bool crosses(const VectorX& from, const VectorX& to) {
    return barriers &&
           barriers->between(from.data(), to.data(), [this](const double* z) { return energy(z, z + n_); });
  }

  double sense = 1.0;  ///< Direction of time; -1 follows the orbit backwards.
  bool timed = false;  ///< Whether the last coordinate is time, which has a unit of its own.
  std::shared_ptr<const Switches> switches = {};  ///< Times at which H switches, if any.
  bool has_kinks = false;                         ///< Whether H has kinks.
  std::optional<Barriers> barriers = {};          ///< Where H is infinite, if it may be.
  std::function<double(const VectorX&)> limit;    ///< Longest step of a sketch from a point, if limited.

 private:
  using Duals = Program::Room<Partials<double, 1>>;
  static double sign(unsigned& bits) {
    bits = bits * 1664525u + 1013904223u;
    return bits >> 31 ? 1.0 : -1.0;
  }
  /// Sets w to the derivative of the field at z along v.
  void linear(Duals& room, const VectorX& z, const VectorX& v, VectorX& w) {
    for (int i = 0; i < 2 * n_; ++i)
      room.arguments()[i] = Partials<double, 1>::variable(z[i], 0, v[i]);
    formula_.program.run(room);
    for (int i = 0; i < n_; ++i) {
      w[i] = formula_.program.slope(room, n_ + i).partial(0);
      w[n_ + i] = -formula_.program.slope(room, i).partial(0);
    }
  }
  std::shared_ptr<const Recording> recording_;
  int n_;
  RecordedFormula<double> formula_;  // H with its gradient
  VectorX moved_, there_;            // scratch
  int energies_ = 0;                 // evaluations of H alone before it has a program
  std::optional<RecordedFormula<double>> value_;
};

}  // namespace avi::detail
