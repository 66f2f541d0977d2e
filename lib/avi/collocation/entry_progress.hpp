#pragma once
#include "avi/collocation/stage_values.hpp"

#include <algorithm>
#include <limits>
#include <utility>

/// @file
/// Which entries of a step still come closer to its solution.

namespace avi {

/// The smallest change so far of every entry, in the manner of Antonana, Makazaga and Murua (2017). Rounding
/// stops entries at different levels: cancellation far from the origin stops some, and where a monitor's
/// gradient is multiplied by the rounding error of H it stops light bodies long before heavy ones. So a step
/// goes on while any entry improves. It is looked at so closely only where changes do not fall as they
/// should.
template <int n, int w>
class EntryProgress {
 public:
  using Step = StageValues<n, w>;  ///< The unknowns of the equations.

  /// For problems of this size.
  explicit EntryProgress(Eigen::Index size) : q_(size), p_(size) {}

  static constexpr double usual_noise = 1e5 * std::numeric_limits<double>::epsilon();  ///< See restart().

  /// Nothing is known yet. @param noise changes that may be noise whatever they are beside the largest entry
  void restart(double noise = usual_noise) {
    most_noise_ = noise;
    q_.restart();
    p_.restart();
    least_change_ = std::numeric_limits<double>::infinity();
    idle_ = looks_ = 0;
  }

  /// A sweep has led from the old q and p to those of the step, whose scales are set.
  [[gnu::noinline]] void look(const Step& old, const Step& step) {
    change_ = 0.0;
    improves_ = false;
    small_ = hidden_ = true;
    const bool anew = looks_ % window == 0;
    ++looks_;
    compare(old.q, step.q, step.per.q, q_, anew);
    compare(old.p, step.p, step.per.p, p_, anew);
    idle_ = improves_ ? 0 : idle_ + 1;
    least_change_ = std::min(least_change_, change_);
  }

  /// Largest change of an entry in its own scale, at the last look.
  [[nodiscard]] double change() const { return change_; }
  /// Every entry has converged, or none has improved for so many looks, and what is left is noise: small in
  /// its own scale; or small beside the largest entry alone, for six looks and not growing. Sweeps that
  /// hardly contract look like that, too. @param hidden the latter counts: there is no better way to solve
  /// the step
  [[nodiscard]] bool settled(int looks, bool hidden) const {
    return change_ <= epsilon ||
           (idle_ >= looks && (small_ || (hidden && hidden_)) && change_ <= 8.0 * least_change_);
  }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();
  using Vec = Vector<Pack<w>, n>;
  static constexpr int window = 3;  // looks whose largest changes are compared with those before
  /// The changes of entries of q, or of p: the smallest, the largest of this window and of the last one.
  struct Record {
    explicit Record(Eigen::Index size) : least(size), recent(size), former(size) {}
    void restart() {
      least.setConstant(std::numeric_limits<double>::infinity());
      recent.setZero();
      former.setZero();
    }
    Vector<double, n> least, recent, former;
  };
  void compare(const Vec& old, const Vec& now, const Vector<double, n>& per, Record& record, bool anew) {
    const double of_largest = EntryScales<n>::of_largest(per);
    const bool complete = looks_ >= 2 * window && looks_ % window == 0;
    for (Eigen::Index i = 0; i < now.size(); ++i) {
      const double moved = largest(Pack<w>(now[i] - old[i]));
      const double own = moved * per[i], beside = moved * of_largest;
      change_ = own <= change_ || change_ != change_ ? change_ : own;
      if (anew) record.former[i] = std::exchange(record.recent[i], 0.0);
      record.recent[i] = std::max(record.recent[i], moved);
      if (own > epsilon) {
        improves_ = improves_ || moved <= 0.5 * record.least[i];
        const bool steady = complete && record.recent[i] <= 1.5 * record.former[i];
        small_ = small_ && own <= most_noise_;
        hidden_ = hidden_ && (own <= most_noise_ || (beside <= 1e3 * epsilon && steady));
      }
      record.least[i] = std::min(record.least[i], moved);
    }
  }

  Record q_, p_;
  double change_ = 0.0, least_change_ = 0.0;
  double most_noise_ = usual_noise;
  int idle_ = 0, looks_ = 0;
  bool improves_ = false, small_ = false, hidden_ = false;
};

}  // namespace avi
