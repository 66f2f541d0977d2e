#pragma once
#include "avi/optim/sweep.hpp"

#include <algorithm>
#include <vector>

/// @file
/// The variable mass matrix of avi::minimise(): an inverse Hessian from the last few displacements.

namespace avi {

/// The last m pairs of displacement s and change of gradient y, and the inverse Hessian H that the BFGS
/// formula builds from them, starting with \f$\gamma I\f$, \f$\gamma = s\cdot y/|y|^2\f$ of the newest pair.
/// H is never formed: H g takes two loops over the pairs (Nocedal 1980), 8 m numbers read or written for each
/// entry.
class SecantPairs {
 public:
  /// Room for m pairs of size n.
  SecantPairs(int m, Eigen::Index n) : pairs_(m), weights_(m) {
    for (Pair& pair : pairs_) {
      pair.s.resize(n);
      pair.y.resize(n);
    }
  }

  [[nodiscard]] int capacity() const { return static_cast<int>(pairs_.size()); }  ///< m.
  [[nodiscard]] int size() const { return stored_; }                              ///< Pairs held.
  void clear() { stored_ = 0; }                                                   ///< H = I again.

  /// Memory for the coming pair, which becomes the newest with commit().
  [[nodiscard]] double* next_s() { return pairs_[next_].s.data(); }
  [[nodiscard]] double* next_y() { return pairs_[next_].y.data(); }  ///< Likewise for y.

  /// Takes what was written to next_s() and next_y(); sy = s.y > 0, yy = |y|^2.
  void commit(double sy, double yy) {
    pairs_[next_].rho = 1.0 / sy;
    gamma_ = sy / yy;
    next_ = (next_ + 1) % capacity();
    stored_ = std::min(stored_ + 1, capacity());
  }

  /// d = -H g. Each pass subtracts one vector and takes the product with the next one that is due.
  void direction(const VectorX& g, VectorX& d) {
    const Eigen::Index n = g.size();
    double* out = d.data();
    const double* from = g.data();
    if (stored_ == 0) {
      sweep<0>(n, [&](auto at, auto&) { at.set(out, -at(from)); });
      return;
    }
    double product =
        sweep<1>(n, [from, s = newest(0).s.data()](auto at, auto& sum) { sum[0] += at(s) * at(from); })[0];
    for (int k = 0; k < stored_; ++k) {
      const Pair& pair = newest(k);
      const double a = weights_[k] = pair.rho * product;
      const double* y = pair.y.data();
      // after the last pair the second loop begins, which needs y . q of the new q
      const double* due = k + 1 < stored_ ? newest(k + 1).s.data() : y;
      const double scale = k + 1 < stored_ ? 1.0 : gamma_;
      product = sweep<1>(n, [=](auto at, auto& sum) {
        const auto q = scale * (at(from) - a * at(y));
        at.set(out, q);
        sum[0] += at(due) * q;
      })[0];
      from = out;
    }
    for (int k = stored_; k-- > 0;) {
      const Pair& pair = newest(k);
      const double a = weights_[k] - pair.rho * product, sign = k > 0 ? 1.0 : -1.0;
      const double* s = pair.s.data();
      const double* due = newest(k > 0 ? k - 1 : 0).y.data();
      product = sweep<1>(n, [=](auto at, auto& sum) {
        const auto q = sign * (at(out) + a * at(s));
        at.set(out, q);
        sum[0] += at(due) * q;
      })[0];
    }
  }

 private:
  struct Pair {
    VectorX s, y;
    double rho = 0.0;
  };
  [[nodiscard]] const Pair& newest(int k) const {
    return pairs_[(next_ + 2 * capacity() - 1 - k) % capacity()];
  }

  std::vector<Pair> pairs_;
  std::vector<double> weights_;
  double gamma_ = 1.0;
  int next_ = 0, stored_ = 0;
};

}  // namespace avi
