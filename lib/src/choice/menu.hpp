#pragma once
#include "src/choice/overview.hpp"

#include <algorithm>
#include <string>
#include <vector>

/// @file
/// The candidates for an orbit, and the steps that their runs begin with.

namespace avi::detail {

/// Smallest number of steps of runs that are compared: the last step is cut to end on time, and in shorter
/// runs it would be the same in both.
inline constexpr int fewest = 3;
/// Ratio of the longer to the shorter step of two runs that are compared.
inline constexpr double longer = 1.25;

/// The candidates for an orbit, the most promising first, and the steps that their runs begin with.
class Menu {
 public:
  /// An empty menu.
  Menu(const OrbitQuestion& question, Overview& overview) : question_(question), known_(overview) {}

  /// Writes the menu of an orbit that has been looked over, and sets the order of the first runs.
  /// @param choice constants of the monitors; those of `poles` are set where they are needed
  /// @throws std::invalid_argument if the monitor that was asked for has no meaning for this H
  void write(Choice& choice);

  /// Order of the runs of a candidate.
  [[nodiscard]] int order_of(const Candidate& it) const { return it.splits() ? 6 : order_; }
  /// Returns true if more than one candidate is not set aside.
  [[nodiscard]] bool has_a_choice() const { return std::ranges::count(all, false, &Candidate::aside) > 1; }
  /// Returns the step with which a candidate begins.
  double first_step(const Candidate& it);
  /// Returns the longest step with which two runs can be compared.
  [[nodiscard]] double longest_step(const Candidate& it) const {
    const double time = std::max(known_.sketch->time, 1e-300);
    return std::min(it.between, (it.fictive > 0.0 ? known_.span * it.fictive / time : known_.span) / fewest);
  }
  /// Returns the longest fixed step whose sweeps still contract if something moves a little faster than the
  /// sketch shows; for the splitting, the longest step with which small oscillations stay small.
  double stable_step(const Candidate& it);
  /// Returns the number of steps h that a candidate should take for a time.
  [[nodiscard]] double expected_steps(const Candidate& it, double h, double time) const {
    return time * it.fictive / std::max(known_.sketch->time, 1e-300) / h;
  }

  std::vector<Candidate> all;  ///< The candidates, the most promising first.

 private:
  void take_the_named(const std::string& wanted, const Choice& choice);
  void offer_splitting();

  const OrbitQuestion& question_;
  Overview& known_;
  int order_ = 16;         // order of collocation
  double aim_ = 1e-15;     // wanted error per radian
  double fastest_ = -1.0;  // frequency at the start; negative if not known yet
};

}  // namespace avi::detail
