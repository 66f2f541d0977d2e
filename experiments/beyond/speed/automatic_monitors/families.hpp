#pragma once
#include "beyond/speed/automatic_monitors/scenes.hpp"

#include "avi/autodiff/reverse.hpp"

#include <algorithm>

/// @file
/// Monitors that exist for every problem, the paper's among them.

namespace experiment {

/// A Hamiltonian as a graph with its slopes.
class Slopes {
 public:
  explicit Slopes(const avi::PhaseFunction& energy)
      : graph(2 * static_cast<int>(energy.size())), n_(graph.inputs() / 2) {
    V q(n_), p(n_);
    for (int i = 0; i < n_; ++i) {
      q[i] = Recorded(graph, i);
      p[i] = Recorded(graph, n_ + i);
    }
    energy_ = energy(q, p).node_in(graph);
    slopes_ = avi::Reverse(graph).gradient(energy_);
  }

  /// \f$(|\dot q|^2 + |\dot p|^2)^{-\alpha}\f$; \f$\alpha = 1/2\f$ is the arclength of phase space.
  avi::PhaseFunction arclength(double alpha) {
    int sum = graph.constant(0.0);
    for (const int slope : slopes_)
      sum = plus(sum, times(slope, slope));
    return {graph, graph.power(sum, -alpha)};
  }
  /// \f$(p\cdot\partial H/\partial p + c)^{-\alpha}\f$: twice the kinetic energy, with a floor.
  avi::PhaseFunction energy(double c, double alpha) {
    return {graph, graph.power(plus(work(), graph.constant(c)), -alpha)};
  }
  /// \f$(L^2 + c)^{-\alpha}\f$ with the Lagrangian.
  avi::PhaseFunction lagrangian(double c, double alpha) {
    const int l = graph.binary(avi::Operation::subtract, work(), energy_);
    return {graph, graph.power(plus(times(l, l), graph.constant(c)), -alpha)};
  }

 private:
  int plus(int a, int b) { return graph.binary(avi::Operation::add, a, b); }
  int times(int a, int b) { return graph.binary(avi::Operation::multiply, a, b); }
  int work() {
    int sum = graph.constant(0.0);
    for (int i = 0; i < n_; ++i)
      sum = plus(sum, times(n_ + i, slopes_[n_ + i]));  // the inputs are the first nodes
    return sum;
  }

  avi::ExpressionGraph graph;
  int n_, energy_ = -1;
  std::vector<int> slopes_;
};

/// The paper's energy monitor and its inverse Lagrangian, with floors and exponents that one would scan, and
/// the arclength to other powers.
inline std::vector<HandMade> scanned_families(const Scene& scene) {
  const double h0 = scene.energy(scene.start.q, scene.start.p);
  Slopes slopes(scene.energy);
  std::vector<HandMade> families;
  for (const double alpha : {0.5, 1.0, 1.5})
    for (const double floor : {0.1, 1.0})
      families.push_back({"energy", slopes.energy(floor * std::max(0.1, std::abs(h0)), alpha)});
  for (const double alpha : {0.5, 0.75})
    families.push_back({"inverse_lagrangian", slopes.lagrangian(h0 * h0 + 0.01, alpha)});
  families.push_back({"arclength^0.5", slopes.arclength(0.25)});
  families.push_back({"arclength^1.5", slopes.arclength(0.75)});
  return families;
}

}  // namespace experiment
