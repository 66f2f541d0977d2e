#pragma once
#include "avi/core/bracketed_root.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"
#include "avi/core/step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <vector>

/// @file
/// Trajectory: the stored states of a run.

namespace avi {

/// An observer of steps that stores every state of a run, including the start, so that states can be read,
/// written or interpolated: `Trajectory<2> path; integrate(method, z, h, until, path);`. Storing allocates
/// memory. Consecutive runs may be stored in one Trajectory as long as their fictive time is the same, that
/// is, with one monitor. A run with another monitor needs its own Trajectory, because at() assumes that the
/// states are smooth in fictive time.
template <int n>
class Trajectory {
 public:
  /// Stores a step. @throws std::invalid_argument unless the step begins where the last one ended and
  /// continues in the same direction of time.
  template <class M>
  void operator()(const Step<M, State<n>>& step, long) {
    if (states_.empty()) {
      states_.push_back(step.before);
      steps_.push_back(0.0);
    }
    require(step.before.t == states_.back().t, "Begin of the next step", step.before.t,
            "where the trajectory ends, at t = ", states_.back().t);
    require(step.before == states_.back(), "Begin of the next step", "another state",
            "that in which the trajectory ends, at t = ", states_.back().t);
    const double whole = states_.back().t - states_.front().t;
    const double way = step.after.t - step.before.t;
    require(!(whole > 0.0 ? way < 0.0 : whole < 0.0 && way > 0.0), "Time after the next step", step.after.t,
            "on the side of t = ", step.before.t, " to which the trajectory leads");
    states_.push_back(step.after);
    steps_.push_back(step.h);
  }

  [[nodiscard]] const std::vector<State<n>>& states() const { return states_; }  ///< In the order of the run.

  /// The state at physical time t, from the polynomial of degree 7 through the 8 nearest states. It is a
  /// polynomial in fictive time, in which a monitor makes the motion even. The error is O(h^8) for a smooth
  /// motion. States much closer to the next one than the others, such as the last state of a run, are
  /// skipped. Where only m < 8 states are available, the degree is m - 1 and the error O(h^m): after one
  /// step, a straight line.
  /// @throws std::invalid_argument for t outside the run.
  [[nodiscard]] State<n> at(double t) const {
    require(states_.size() > 1, "Number of stored states", states_.size(), "at least 2 to evaluate between");
    const double sense = std::copysign(1.0, states_.back().t - states_.front().t);
    require(sense * t >= sense * states_.front().t && sense * t <= sense * states_.back().t,
            "Time in the trajectory", t, "between its ends, ", states_.front().t, " and ", states_.back().t);
    const auto later =
        std::upper_bound(states_.begin() + 1, states_.end() - 1, t,
                         [&](double time, const State<n>& z) { return sense * time < sense * z.t; });
    const auto k = static_cast<std::size_t>(later - states_.begin());  // t lies between states k - 1 and k
    const Nodes nodes = around(k);
    State<n> z = states_[k];
    const auto move_to = [&](double tau) {  // sets z to the state at tau, except that z.t is its time minus t
      z.q.setZero();
      z.p.setZero();
      z.t = 0.0;
      for (std::size_t i = 0; i < nodes.count; ++i) {
        double weight = 1.0;  // Lagrange polynomial i
        for (std::size_t j = 0; j < nodes.count; ++j)
          if (j != i) weight *= (tau - nodes.tau[j]) / (nodes.tau[i] - nodes.tau[j]);
        const State<n>& there = states_[nodes.state[i]];
        z.q += weight * there.q;
        z.p += weight * there.p;
        z.t += weight * (there.t - t);
      }
      return sense * z.t;
    };
    const double from = sense * (states_[k - 1].t - t), to = sense * (states_[k].t - t);
    const auto tau_at = [&](double c) { return c * steps_[k]; };
    if (from == 0.0 || to == 0.0)
      z = states_[from == 0.0 ? k - 1 : k];
    else
      move_to(
          tau_at(bracketed_root([&](double c) { return move_to(tau_at(c)); }, 0.0, from, 1.0, to, 0.0).x));
    z.t = t;
    return z;
  }

  /// Writes a table with tabs between columns and a header line t q_1 ... p_n. Numbers have 17 digits, so
  /// that reading them back gives the same values.
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
  static constexpr double near = 0.125;  // least distance of neighbouring nodes, as a part of the widest gap
  /// The nodes of the polynomial, in the order of the run, with fictive times measured from the beginning of
  /// the step.
  struct Nodes {
    std::size_t count = 0;
    std::array<std::size_t, points> state{};
    std::array<double, points> tau{};
  };

  /// The nodes for step k: its ends and the nearest states on both sides. A state much closer to the last
  /// node than nodes are to each other is skipped, such as one next to the end of a run or an event, because
  /// differences between the two would be mostly rounding error. Times are summed outwards from the step, so
  /// that their rounding error does not depend on the length of the run.
  [[nodiscard]] Nodes around(std::size_t k) const {
    const auto add = [](Nodes& nodes, std::size_t state, double tau) {
      nodes.state[nodes.count] = state;
      nodes.tau[nodes.count++] = tau;
    };
    const auto side = [&](std::size_t state, double tau, bool back) {
      Nodes nodes;
      add(nodes, state, tau);
      double gap = 0.0, widest = std::abs(steps_[k]);
      while (nodes.count < points && (back ? state > 0 : state + 1 < states_.size())) {
        const double step = back ? -steps_[state--] : steps_[++state];
        tau += step;
        gap += step;
        if (std::abs(gap) < near * widest) continue;
        add(nodes, state, tau);
        widest = std::max(widest, std::abs(gap));
        gap = 0.0;
      }
      return nodes;
    };
    const Nodes left = side(k - 1, 0.0, true), right = side(k, steps_[k], false);
    const std::size_t count = std::min(points, left.count + right.count), half = count / 2;
    const std::size_t before = std::clamp(half, count - std::min(count, right.count), left.count);
    Nodes nodes;
    for (std::size_t i = before; i-- > 0;)
      add(nodes, left.state[i], left.tau[i]);
    for (std::size_t i = 0; i < count - before; ++i)
      add(nodes, right.state[i], right.tau[i]);
    return nodes;
  }

  std::vector<State<n>> states_;
  std::vector<double> steps_;  // fictive step that leads to each state from the one before
};

}  // namespace avi
