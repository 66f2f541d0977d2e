#pragma once
#include "avi/collocation/stage_values.hpp"

#include <algorithm>
#include <limits>
#include <utility>

/// @file
/// EntryProgress: which entries of a step still converge, and when the iteration is finished.

namespace avi {

/// Records the smallest change so far of each entry during the iteration of a step, in the manner of
/// Antonana, Makazaga and Murua (2017). Rounding stops entries at different levels: some because of
/// cancellation far from the origin, and light bodies long before heavy ones, because the gradient of a
/// monitor is multiplied by the rounding error of H. So an iteration continues while any entry improves. This
/// closer look is needed only where changes do not fall as they should.
template <int n, int w>
class EntryProgress {
 public:
  using Step = StageValues<n, w>;  ///< The unknowns of the equations.

  /// For a problem with n = `size`.
  explicit EntryProgress(Eigen::Index size) : q_(size), p_(size) {}

  static constexpr double usual_noise = 1e5 * std::numeric_limits<double>::epsilon();  ///< See restart().

  /// Starts anew. @param noise changes of an entry, relative to its own size, that may be noise however they
  /// compare with the largest entry
  void restart(double noise = usual_noise) {
    most_noise_ = noise;
    q_.restart();
    p_.restart();
    least_change_ = std::numeric_limits<double>::infinity();
    idle_ = looks_ = 0;
  }

  /// Compares the old q and p with those of the step after one iteration. The scales of the step must be set.
  [[gnu::noinline]] void look(const Step& old, const Step& step) {
    change_ = 0.0;
    improves_ = false;
    small_ = hidden_ = true;
    const bool anew = looks_ % window == 0;
    ++looks_;
    compare(old.q, step.q, step.per.q, q_, anew, rests(old.p, step.p));
    compare(old.p, step.p, step.per.p, p_, anew, rests(old.q, step.q));
    idle_ = improves_ ? 0 : idle_ + 1;
    least_change_ = std::min(least_change_, change_);
  }

  /// Largest relative change of an entry, in its own scale, at the last look.
  [[nodiscard]] double change() const { return change_; }
  /// True where every entry has converged, or where none has improved for `looks` looks and the remaining
  /// changes are noise. Noise is small in the entry's own scale. Or, if `hidden`, it is small beside the
  /// largest entry, or of momenta while positions change in their last digits only, or the other way round,
  /// and has not grown for six looks; sweeps that hardly contract look like this too.
  /// @param looks number of looks without improvement @param hidden accept this second kind: there is no
  /// better way to solve the step
  [[nodiscard]] bool settled(int looks, bool hidden) const {
    return change_ <= epsilon ||
           (idle_ >= looks && (small_ || (hidden && hidden_)) && change_ <= 8.0 * least_change_);
  }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();
  using Vec = Vector<Pack<w>, n>;
  static constexpr int window = 3;  // looks in a window; largest changes of consecutive windows are compared
  /// Changes of each entry of q, or of p: the smallest so far, the largest in this window, and in the last
  /// one.
  struct Record {
    explicit Record(Eigen::Index size) : least(size), recent(size), former(size) {}
    void restart() {
      least.setConstant(std::numeric_limits<double>::infinity());
      recent.setZero();
      former.setZero();
    }
    Vector<double, n> least, recent, former;
  };
  /// True where entries change by rounding of their own size only, at most. Changes of what depends on them
  /// alone are then rounding, too, as of a stiff force near its zero.
  static bool rests(const Vec& old, const Vec& now) {
    for (Eigen::Index i = 0; i < now.size(); ++i)
      if (!(largest(Pack<w>(now[i] - old[i])) <= 4.0 * epsilon * largest(now[i]))) return false;
    return true;
  }
  void compare(const Vec& old, const Vec& now, const Vector<double, n>& per, Record& record, bool anew,
               bool others_rest) {
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
        const bool beneath = beside <= 1e3 * epsilon || (others_rest && own <= 1e-3);
        hidden_ = hidden_ && (own <= most_noise_ || (beneath && steady));
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
