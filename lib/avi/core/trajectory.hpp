#pragma once
#include "avi/core/bracketed_root.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"
#include "avi/core/step.hpp"

#include <algorithm>
#include <limits>
#include <ostream>
#include <vector>

/// @file
/// A run whose states are stored.

namespace avi {

/// Observer of steps that stores every state of a run, the start included, to be read, written or evaluated
/// in between: `Trajectory<2> path; integrate(method, z, h, until, path);`. Storing allocates.
template <int n>
class Trajectory {
 public:
  /// Stores a step. @throws std::invalid_argument unless it begins where the last one ended.
  template <class M>
  void operator()(const Step<M, State<n>>& step, long) {
    if (states_.empty()) {
      states_.push_back(step.before);
      tau_.push_back(0.0);
    }
    require(step.before.t == states_.back().t, "Begin of the next step", step.before.t,
            "where the trajectory ends, at t = ", states_.back().t);
    states_.push_back(step.after);
    tau_.push_back(tau_.back() + step.h);
  }

  [[nodiscard]] const std::vector<State<n>>& states() const { return states_; }  ///< In the order of the run.

  /// The state at physical time t, by the polynomial of degree 7 through the nearest states in fictive time,
  /// where a monitor makes the motion even. Its error is O(h^8) for a smooth motion.
  /// @throws std::invalid_argument for t outside the run.
  [[nodiscard]] State<n> at(double t) const {
    require(states_.size() > 1, "Number of stored states", states_.size(), "at least 2 to evaluate between");
    const double sense = std::copysign(1.0, states_.back().t - states_.front().t);
    require(sense * t >= sense * states_.front().t && sense * t <= sense * states_.back().t,
            "Time in the trajectory", t, "between its ends, ", states_.front().t, " and ", states_.back().t);
    const auto later =
        std::upper_bound(states_.begin() + 1, states_.end() - 1, t,
                         [&](double time, const State<n>& z) { return sense * time < sense * z.t; });
    const auto k = static_cast<std::size_t>(later - states_.begin());  // t in [k - 1, k]
    const std::size_t count = std::min(points, states_.size());
    const std::size_t first = std::clamp(k, count / 2, states_.size() - (count - count / 2)) - count / 2;
    State<n> z = states_[first];
    const auto move_to = [&](double tau) {  // leaves in z.t the time there less t
      z.q.setZero();
      z.p.setZero();
      z.t = 0.0;
      for (std::size_t i = first; i < first + count; ++i) {
        double weight = 1.0;  // Lagrange's polynomial i
        for (std::size_t j = first; j < first + count; ++j)
          if (j != i) weight *= (tau - tau_[j]) / (tau_[i] - tau_[j]);
        z.q += weight * states_[i].q;
        z.p += weight * states_[i].p;
        z.t += weight * (states_[i].t - t);
      }
      return sense * z.t;
    };
    const double from = sense * (states_[k - 1].t - t), to = sense * (states_[k].t - t);
    const auto tau_at = [&](double c) { return tau_[k - 1] + c * (tau_[k] - tau_[k - 1]); };
    if (from == 0.0 || to == 0.0)
      move_to(tau_at(from == 0.0 ? 0.0 : 1.0));
    else
      move_to(
          tau_at(bracketed_root([&](double c) { return move_to(tau_at(c)); }, 0.0, from, 1.0, to, 0.0).x));
    z.t = t;
    return z;
  }

  /// Writes a table with a line of names, t q_1 ... p_n, and tabs between the columns; 17 digits, so that
  /// reading it gives the same numbers.
  void write(std::ostream& out) const {
    const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
    const Eigen::Index size = states_.empty() ? 0 : states_.front().q.size();
    out << 't';
    for (const char* name : {"q", "p"})
      for (Eigen::Index i = 1; i <= size; ++i)
        out << '\t' << name << '_' << i;
    out << '\n';
    for (const State<n>& z : states_) {
      out << z.t;
      for (const auto* x : {&z.q, &z.p})
        for (Eigen::Index i = 0; i < size; ++i)
          out << '\t' << (*x)[i];
      out << '\n';
    }
    out.precision(precision);
  }

 private:
  static constexpr std::size_t points = 8;
  std::vector<State<n>> states_;
  std::vector<double> tau_;  // fictive time
};

}  // namespace avi
