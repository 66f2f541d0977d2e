#pragma once
#include "src/minimise/diagonal_mass.hpp"

#include <algorithm>
#include <vector>

/// @file
/// The variable mass matrix of avi::minimise(): an inverse Hessian from the last few displacements.

namespace avi {

/// The last m pairs of displacement s and change of gradient y, and the inverse Hessian H that the BFGS
/// formula builds from them, starting with \f$\gamma W\f$, \f$\gamma = s\cdot y/(y\cdot W y)\f$ of the newest
/// pair. W is the inverse of a mass for every entry (DiagonalMass) if that predicted the last m pairs clearly
/// better than I, and I otherwise; that is decided at every m-th pair, if m is at least 5. H is never formed.
///
/// H g is a combination of the s, plus W times a combination of g and the y. The coefficients follow from
/// products alone: those of g with every s and W y (multiply(), one pass over the pairs), and those of the
/// pairs with each other, which are differences of such products, as y is a difference of gradients. So the
/// two loops (Nocedal 1980) run on 2 m numbers instead of on vectors, and direction() takes one pass more:
/// 4 m numbers are read for each entry, where loops over vectors read or write 8 m (Byrd, Nocedal and
/// Schnabel 1994; Chen, Wang and Zhou 2014).
class SecantPairs {
 public:
  /// Makes room for m pairs of size n.
  SecantPairs(int m, Eigen::Index n)
      : n_(n), m_(m), pairs_(m), sy_(m * m), yy_(sy_), weights_(m), u_(m), mass_(m >= lesson ? n : 0),
        ones_(std::min(block, n), 1.0) {
    for (Pair& pair : pairs_) {
      pair.s.resize(n);
      pair.y.resize(n);
    }
  }

  [[nodiscard]] int size() const { return stored_; }         ///< Number of pairs held.
  [[nodiscard]] bool weighted() const { return weighted_; }  ///< Whether W is not I.

  [[nodiscard]] const double* inverse_masses() const { return mass_.inverse(); }  ///< W, where weighted().

  /// Resets H to I.
  void clear() {
    stored_ = next_ = unlearned_ = 0;
    weighted_ = false;
    mass_.forget();
  }

  /// Count of the numbers that multiply() writes.
  [[nodiscard]] Eigen::Index products() const { return 2 * m_; }

  /// Memory for the coming pair, which becomes the newest with commit().
  [[nodiscard]] double* next_s() { return pairs_[next_].s.data(); }
  [[nodiscard]] double* next_y() { return pairs_[next_].y.data(); }  ///< Memory for y, likewise.

  /// Computes the products of g with every s, then with every W y.
  void multiply(const double* g, double* products) const {
    std::fill_n(products, 2 * m_, 0.0);
    for (Eigen::Index from = 0; from < n_; from += block) {
      const Eigen::Index count = std::min(block, n_ - from);
      int k = 0;
      for (; k + 2 <= stored_; k += 2) {
        const auto sums = sweep<4>(count, [g = g + from, w = weights(from), s = pairs_[k].s.data() + from,
                                           y = pairs_[k].y.data() + from, s1 = pairs_[k + 1].s.data() + from,
                                           y1 = pairs_[k + 1].y.data() + from](auto at, auto& sum) {
          const auto entry = at(g), weighed = at(w) * entry;
          sum[0] += at(s) * entry;
          sum[1] += at(s1) * entry;
          sum[2] += at(y) * weighed;
          sum[3] += at(y1) * weighed;
        });
        products[k] += sums[0];
        products[k + 1] += sums[1];
        products[m_ + k] += sums[2];
        products[m_ + k + 1] += sums[3];
      }
      if (k == stored_) continue;
      const auto sums = sweep<2>(count, [g = g + from, w = weights(from), s = pairs_[k].s.data() + from,
                                         y = pairs_[k].y.data() + from](auto at, auto& sum) {
        const auto entry = at(g);
        sum[0] += at(s) * entry;
        sum[1] += at(y) * (at(w) * entry);
      });
      products[k] += sums[0];
      products[m_ + k] += sums[1];
    }
  }

  /// Takes what was written to next_s() and next_y(). @param g the new gradient
  /// @param sy s.y > 0
  /// @param yy |y|^2
  /// @param change products of y with every pair: those of the new gradient less those of the old one
  /// @param now products of the new gradient, which get those with the new pair, sg = s.g and yg = y.g
  void commit(const double* g, double sy, double yy, const double* change, double* now, double sg,
              double yg) {
    const int c = next_;
    next_ = (next_ + 1) % m_;
    stored_ = std::min(stored_ + 1, m_);
    pairs_[c].rho = 1.0 / sy;
    for (int k = 0; k < stored_; ++k)
      sy_[c * m_ + k] = change[k];
    sy_[c * m_ + c] = sy;
    if (++unlearned_ == m_ && m_ >= lesson && learn()) {
      gamma_ = sy / yy_[c * m_ + c];
      return multiply(g, now);
    }
    if (weighted_) {
      const auto sums = sweep<2>(n_, [g, w = mass_.inverse(), y = pairs_[c].y.data()](auto at, auto& sum) {
        const auto weighed = at(w) * at(y);
        sum[0] += weighed * at(y);
        sum[1] += weighed * at(g);
      });
      yy = sums[0], yg = sums[1];
    }
    for (int k = 0; k < stored_; ++k)
      yy_[c * m_ + k] = yy_[k * m_ + c] = change[m_ + k];
    yy_[c * m_ + c] = yy;
    now[c] = sg;
    now[m_ + c] = yg;
    gamma_ = sy / yy;
  }

  /// Discards what was written, which is no pair; it may have taken the place of the oldest.
  void discard() { pairs_[next_].rho = 0.0; }

  /// Sets d = -H g, by the products of g. Returns d.g and |d|^2.
  std::array<double, 2> direction(const double* g, const double* products, double* d) {
    // the two loops, as triangular systems that are solved entry by entry: an entry waits for only one
    // product of the one before
    const int last = older(next_), first = stored_ < m_ ? 0 : next_;
    for (int i = last, left = stored_; left > 0; --left, i = older(i)) {
      double u = products[i];
      for (int k = last; k != i; k = older(k))
        u -= weights_[k] * sy_[k * m_ + i];
      weights_[i] = pairs_[i].rho * u;
    }
    const double gamma = stored_ > 0 ? gamma_ : 1.0;
    for (int i = first, left = stored_; left > 0; --left, i = newer(i)) {
      double v = products[m_ + i];
      for (int k = last, others = stored_; others > 0; --others, k = older(k))
        v -= weights_[k] * yy_[i * m_ + k];
      v *= gamma;
      for (int k = first; k != i; k = newer(k))
        v += u_[k] * sy_[i * m_ + k];
      u_[i] = weights_[i] - pairs_[i].rho * v;
    }
    std::array<double, 2> sums{};
    for (Eigen::Index from = 0; from < n_; from += block) {
      const Eigen::Index count = std::min(block, n_ - from);
      double* out = d + from;
      const double* old = g + from;
      const double* w = weights(from);
      sweep<0>(count, [=](auto at, auto&) { at.set(out, -gamma * (at(w) * at(old))); });
      int k = 0;
      for (; k + 2 <= stored_; k += 2)
        sweep<0>(count,
                 [out, w, s = pairs_[k].s.data() + from, y = pairs_[k].y.data() + from,
                  s1 = pairs_[k + 1].s.data() + from, y1 = pairs_[k + 1].y.data() + from, b = u_[k],
                  b1 = u_[k + 1], a = gamma * weights_[k], a1 = gamma * weights_[k + 1]](auto at, auto&) {
                   at.set(out, at(out) + (at(w) * (a * at(y) + a1 * at(y1)) - (b * at(s) + b1 * at(s1))));
                 });
      if (k < stored_)
        sweep<0>(count, [out, w, s = pairs_[k].s.data() + from, y = pairs_[k].y.data() + from, b = u_[k],
                         a = gamma * weights_[k]](auto at, auto&) {
          at.set(out, at(out) + (at(w) * (a * at(y)) - b * at(s)));
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
  /// Block size in entries: several loops over a block read memory once. 1024 instead of 4096 entries costs
  /// about 20 % more time.
  static constexpr Eigen::Index block = 4096;
  static constexpr int lesson = 5;  ///< Fewer pairs say too little about masses.

  /// Diagonal of W from an index on, for one block.
  [[nodiscard]] const double* weights(Eigen::Index from) const {
    return weighted_ ? mass_.inverse() + from : ones_.data();
  }

  /// Gives the pairs since the last time to the masses, and chooses W. Returns true if W may have changed:
  /// then the products of all pairs are those with the new one.
  bool learn() {
    const bool before = weighted_;
    weighted_ =
        mass_.learn(unlearned_, [this](int k) -> const Pair& { return pairs_[newest(unlearned_ - 1 - k)]; });
    unlearned_ = 0;
    if (!before && !weighted_) return false;
    std::fill(yy_.begin(), yy_.end(), 0.0);
    for (Eigen::Index from = 0; from < n_; from += block)
      for (int i = 0; i < stored_; ++i)
        for (int k = 0; k <= i; ++k)
          yy_[k * m_ + i] = yy_[i * m_ + k] +=
              sweep<1>(std::min(block, n_ - from),
                       [w = weights(from), a = pairs_[i].y.data() + from, b = pairs_[k].y.data() + from](
                           auto at, auto& sum) { sum[0] += at(w) * (at(a) * at(b)); })[0];
    return true;
  }
  [[nodiscard]] int newest(int back) const { return (next_ + 2 * m_ - 1 - back) % m_; }
  [[nodiscard]] int older(int i) const { return i == 0 ? m_ - 1 : i - 1; }
  [[nodiscard]] int newer(int i) const { return i + 1 == m_ ? 0 : i + 1; }

  Eigen::Index n_;
  int m_;  ///< Largest number of pairs.
  std::vector<Pair> pairs_;
  std::vector<double> sy_;       ///< Column i: s_j . y_i for every j that is not newer than i.
  std::vector<double> yy_;       ///< Column i: y_j . y_i.
  std::vector<double> weights_;  ///< Coefficients of the first loop.
  std::vector<double> u_;        ///< Coefficients of the second loop.
  DiagonalMass mass_;            ///< Masses of all entries.
  std::vector<double> ones_;     ///< Diagonal of W = I, one block of it.
  bool weighted_ = false;        ///< Whether W is the inverse of the masses.
  int unlearned_ = 0;            ///< Number of pairs that the masses have not learned.
  double gamma_ = 1.0;
  int next_ = 0, stored_ = 0;
};

}  // namespace avi
