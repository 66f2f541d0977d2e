#pragma once
#include "avi/optim/sweep.hpp"

#include <algorithm>
#include <vector>

/// @file
/// The variable mass matrix of avi::minimise(): an inverse Hessian from the last few displacements.

namespace avi {

/// The last m pairs of displacement s and change of gradient y, and the inverse Hessian H that the BFGS
/// formula builds from them, starting with \f$\gamma I\f$, \f$\gamma = s\cdot y/|y|^2\f$ of the newest pair.
/// H is never formed.
///
/// H g is a combination of g and the pairs, and its coefficients follow from products alone: those of g with
/// every pair (multiply(), one pass over the pairs), and those of the pairs with each other, which are
/// differences of such products, as y is a difference of gradients. So the two loops (Nocedal 1980) run on 2
/// m numbers instead of on vectors, and direction() takes one pass more: 4 m numbers are read for each entry
/// where loops over vectors read or write 8 m (Byrd, Nocedal and Schnabel 1994; Chen, Wang and Zhou 2014).
class SecantPairs {
 public:
  /// Room for m pairs of size n.
  SecantPairs(int m, Eigen::Index n)
      : n_(n), pairs_(m), width_((m + 7) / 8 * 8), sy_(zero(width_ * m)), ys_(sy_), yy_(sy_),
        weights_(zero(width_)), u_(weights_), v_(weights_) {
    for (Pair& pair : pairs_) {
      pair.s.resize(n);
      pair.y.resize(n);
    }
  }

  [[nodiscard]] int capacity() const { return static_cast<int>(pairs_.size()); }  ///< m.
  [[nodiscard]] int size() const { return stored_; }                              ///< Pairs held.
  void clear() { stored_ = next_ = 0; }                                           ///< H = I again.

  /// Numbers that multiply() writes.
  [[nodiscard]] Eigen::Index products() const { return 2 * width_; }

  /// Memory for the coming pair, which becomes the newest with commit().
  [[nodiscard]] double* next_s() { return pairs_[next_].s.data(); }
  [[nodiscard]] double* next_y() { return pairs_[next_].y.data(); }  ///< Likewise for y.

  /// The products of g with every s, then with every y.
  void multiply(const double* g, double* products) const {
    std::fill_n(products, 2 * width_, 0.0);
    for (Eigen::Index from = 0; from < n_; from += block) {
      const Eigen::Index count = std::min(block, n_ - from);
      int k = 0;
      for (; k + 2 <= stored_; k += 2) {
        const auto sums = sweep<4>(count, [g = g + from, s = pairs_[k].s.data() + from,
                                           y = pairs_[k].y.data() + from, s1 = pairs_[k + 1].s.data() + from,
                                           y1 = pairs_[k + 1].y.data() + from](auto at, auto& sum) {
          const auto entry = at(g);
          sum[0] += at(s) * entry;
          sum[1] += at(s1) * entry;
          sum[2] += at(y) * entry;
          sum[3] += at(y1) * entry;
        });
        products[k] += sums[0];
        products[k + 1] += sums[1];
        products[width_ + k] += sums[2];
        products[width_ + k + 1] += sums[3];
      }
      if (k == stored_) continue;
      const auto sums = sweep<2>(count, [g = g + from, s = pairs_[k].s.data() + from,
                                         y = pairs_[k].y.data() + from](auto at, auto& sum) {
        const auto entry = at(g);
        sum[0] += at(s) * entry;
        sum[1] += at(y) * entry;
      });
      products[k] += sums[0];
      products[width_ + k] += sums[1];
    }
  }

  /// Takes what was written to next_s() and next_y(). @param sy s.y > 0
  /// @param yy |y|^2
  /// @param change products of y with every pair: those of the new gradient less those of the old one
  /// @param now products of the new gradient, which get those with the new pair, sg and yg
  void commit(double sy, double yy, const double* change, double* now, double sg, double yg) {
    const int c = next_;
    next_ = (next_ + 1) % capacity();
    stored_ = std::min(stored_ + 1, capacity());
    for (int k = 0; k < stored_; ++k) {
      sy_[c * width_ + k] = ys_[k * width_ + c] = change[k];
      yy_[c * width_ + k] = yy_[k * width_ + c] = change[width_ + k];
    }
    sy_[c * width_ + c] = ys_[c * width_ + c] = sy;
    yy_[c * width_ + c] = yy;
    now[c] = sg;
    now[width_ + c] = yg;
    pairs_[c].rho = 1.0 / sy;
    gamma_ = sy / yy;
  }

  /// The same where what was written is no pair; it may have taken the place of the oldest.
  void discard() { pairs_[next_].rho = 0.0; }

  /// d = -H g, with the products of g. Returns d.g and |d|^2.
  std::array<double, 2> direction(const double* g, const double* products, double* d) {
    // u and v: products of s and of y with what the loops make of g; unused places hold zeros
    std::copy_n(products, width_, u_.data());
    std::copy_n(products + width_, width_, v_.data());
    for (int back = 0; back < stored_; ++back) {
      const int i = newest(back);
      const double a = weights_[i] = pairs_[i].rho * u_[i];
      add(-a, &sy_[i * width_], u_.data());
      add(-a, &yy_[i * width_], v_.data());
    }
    const double gamma = stored_ > 0 ? gamma_ : 1.0;
    for (double& product : v_)
      product *= gamma;
    for (int back = stored_; back-- > 0;) {
      const int i = newest(back);
      u_[i] = weights_[i] - pairs_[i].rho * v_[i];
      add(u_[i], &ys_[i * width_], v_.data());
    }
    std::array<double, 2> sums{};
    for (Eigen::Index from = 0; from < n_; from += block) {
      const Eigen::Index count = std::min(block, n_ - from);
      double* out = d + from;
      const double* old = g + from;
      sweep<0>(count, [=](auto at, auto&) { at.set(out, -gamma * at(old)); });
      int k = 0;
      for (; k + 2 <= stored_; k += 2)
        sweep<0>(count,
                 [out, s = pairs_[k].s.data() + from, y = pairs_[k].y.data() + from,
                  s1 = pairs_[k + 1].s.data() + from, y1 = pairs_[k + 1].y.data() + from, b = u_[k],
                  b1 = u_[k + 1], a = gamma * weights_[k], a1 = gamma * weights_[k + 1]](auto at, auto&) {
                   at.set(out, at(out) + ((a * at(y) - b * at(s)) + (a1 * at(y1) - b1 * at(s1))));
                 });
      if (k < stored_)
        sweep<0>(count, [out, s = pairs_[k].s.data() + from, y = pairs_[k].y.data() + from, b = u_[k],
                         a = gamma * weights_[k]](auto at, auto&) {
          at.set(out, at(out) + (a * at(y) - b * at(s)));
        });
      const auto part = sweep<2>(count, [out, old](auto at, auto& sum) {
        const auto entry = at(out);
        sum[0] += entry * at(old);
        sum[1] += entry * entry;
      });
      sums[0] += part[0];
      sums[1] += part[1];
    }
    return sums;
  }

 private:
  struct Pair {
    VectorX s, y;
    double rho = 0.0;
  };
  /// Entries that pass from memory to the nearest cache at a time: several loops over them read memory once.
  static constexpr Eigen::Index block = 1024;

  static std::vector<double> zero(Eigen::Index size) {
    return std::vector<double>(static_cast<std::size_t>(size));
  }
  [[nodiscard]] int newest(int back) const { return (next_ + 2 * capacity() - 1 - back) % capacity(); }
  void add(double c, const double* column, double* to) const {
    sweep<0>(width_, [=](auto at, auto&) { at.set(to, at(to) + c * at(column)); });
  }

  Eigen::Index n_;
  std::vector<Pair> pairs_;
  Eigen::Index width_;           ///< m, filled up to a multiple of eight.
  std::vector<double> sy_;       ///< Column i: s_j . y_i for every j.
  std::vector<double> ys_;       ///< Column i: y_j . s_i.
  std::vector<double> yy_;       ///< Column i: y_j . y_i.
  std::vector<double> weights_;  ///< Of the first loop.
  std::vector<double> u_, v_;    ///< Products with s and with y.
  double gamma_ = 1.0;
  int next_ = 0, stored_ = 0;
};

}  // namespace avi
