#pragma once
#include "avi/collocation/stage_values.hpp"

#include <algorithm>
#include <limits>

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

  /// Nothing is known yet. @param noise changes that may be noise, in the scale of their entry
  void restart(double noise = usual_noise) {
    most_noise_ = noise;
    q_.setConstant(std::numeric_limits<double>::infinity());
    p_.setConstant(std::numeric_limits<double>::infinity());
    least_change_ = std::numeric_limits<double>::infinity();
    idle_ = 0;
  }

  /// A sweep has led from the old q and p to those of the step, whose scales are set.
  [[gnu::noinline]] void look(const Step& old, const Step& step) {
    change_ = 0.0;
    improves_ = false;
    compare(old.q, step.q, step.per.q, q_);
    compare(old.p, step.p, step.per.p, p_);
    idle_ = improves_ ? 0 : idle_ + 1;
    least_change_ = std::min(least_change_, change_);
  }

  /// Largest change of an entry in its own scale, at the last look.
  [[nodiscard]] double change() const { return change_; }
  /// Every entry has converged, or it has not improved for so many looks, and what is left is noise: small in
  /// its own scale.
  [[nodiscard]] bool settled(int looks) const {
    return change_ <= epsilon || (idle_ >= looks && change_ <= most_noise_ && change_ <= 8.0 * least_change_);
  }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();
  using Vec = Vector<Pack<w>, n>;
  void compare(const Vec& old, const Vec& now, const Vector<double, n>& per, Vector<double, n>& least) {
    for (Eigen::Index i = 0; i < now.size(); ++i) {
      const double moved = largest(Pack<w>(now[i] - old[i])), own = moved * per[i];
      change_ = own <= change_ || change_ != change_ ? change_ : own;
      if (own > epsilon) improves_ = improves_ || moved <= 0.5 * least[i];
      least[i] = std::min(least[i], moved);
    }
  }

  Vector<double, n> q_, p_;  // the smallest changes of each entry
  double change_ = 0.0, least_change_ = 0.0;
  double most_noise_ = usual_noise;
  int idle_ = 0;
  bool improves_ = false;
};

}  // namespace avi
