#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/core/outcome.hpp"
#include "avi/optim/objective.hpp"

#include <string_view>
#include <vector>

// Phase-space cloning (Pihajoki 2015) for Bregman dynamics, reduced to the copy whose values are used.

namespace experiment {

using avi::Outcome, avi::VectorX, avi::Iterate, avi::BregmanFamily, avi::BregmanStart, avi::validate;

/// Strang's splitting (order 2) and Yoshida's triple jumps of it (orders 4 and 6).
enum class CloneComposition { strang, yoshida4, yoshida6 };

/// The name of a composition in data files: clone_strang, clone_y4, clone_y6.
constexpr std::string_view clone_name(CloneComposition composition) {
  if (composition == CloneComposition::strang) return "clone_strang";
  return composition == CloneComposition::yoshida4 ? "clone_y4" : "clone_y6";
}

/// Step lengths of B(b_0) A(a_1) B(b_1) ... A(a_m) B(b_m) in units of h, with neighbouring B flows merged.
struct MergedStages {
  std::vector<double> a;  ///< m entries, m = 1, 3, 9.
  std::vector<double> b;  ///< m + 1 entries.
};

/// Step lengths of a composition. The triple jump raises the order 2k of a symmetric step to 2k + 2 with the
/// lengths w, 1 - 2w, w, where w = 1 / (2 - 2^(1/(2k+1))) (Yoshida 1990).
inline MergedStages merged_stages(CloneComposition composition) {
  std::vector<double> lengths{1.0};
  const auto triple_jump = [&](double order) {
    const double w = 1.0 / (2.0 - std::pow(2.0, 1.0 / (order + 1.0)));
    std::vector<double> jumped;
    for (const double outer : {w, 1.0 - 2.0 * w, w})
      for (const double inner : lengths)
        jumped.push_back(outer * inner);
    lengths = std::move(jumped);
  };
  if (composition != CloneComposition::strang) triple_jump(2.0);
  if (composition == CloneComposition::yoshida6) triple_jump(4.0);
  MergedStages stages{.a = lengths, .b = {0.5 * lengths.front()}};
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
    stages.b.push_back(0.5 * (lengths[i] + lengths[i + 1]));
  stages.b.push_back(0.5 * lengths.back());
  return stages;
}

/// Phase-space cloning: two copies \f$(q, t, r)\f$ and \f$(\tilde q, \tilde t, \tilde r)\f$ with the
/// Hamiltonian \f$\bar H_1(q, t, \tilde r) + \bar H_2(\tilde q, \tilde t, r)\f$, split into its two terms. A
/// step is \f$\bar H_2\f$ for half a step, \f$\bar H_1\f$ for a step and \f$\bar H_2\f$ for half a step, or a
/// composition of such steps (equation (4.19) of the paper).
///
/// For given t, \f$\bar H\f$ is separable in q and r, so q is coupled to r only: \f$q' = kinetic(\tilde t)\,
/// r\f$ under \f$\bar H_2\f$ and \f$r' = -potential(t)\, \nabla f(q)\f$ under \f$\bar H_1\f$. The copy (q,
/// r), whose values are used, never depends on \f$(\tilde q, \tilde r)\f$, only on the other clock. So only
/// q, r and the two clocks are evolved here: a leapfrog with 1, 3 or 9 gradients per step, where the printed
/// form takes 3, 7 or 19 for the same iterates. The stopping test at the new q costs one more.
struct BregmanCloning {
  BregmanFamily family;                                     ///< p, p_ring and C.
  double h = 1e-3;                                          ///< Fictive step, finite and positive.
  CloneComposition composition = CloneComposition::strang;  ///< Composition of the two flows.
  BregmanStart from{};                                      ///< Initial time and momentum.

  struct State {
    VectorX r;            ///< Momentum of the copy that is used.
    double t;             ///< Its physical time.
    double t_clone;       ///< Physical time of the other copy.
    MergedStages stages;  ///< Step lengths of the composition.
  };

  State start(const Iterate& first) const {
    validate(family, from, h);
    return {VectorX::Constant(first.x.size(), from.momentum), from.t, from.t, merged_stages(composition)};
  }

  /// One fictive step, with 1, 3 or 9 gradients.
  Outcome update(State& state, Iterate& now, auto& f) const {
    drift(state, now, state.stages.b[0]);
    for (std::size_t i = 0; i < state.stages.a.size(); ++i) {
      kick(state, now, f, state.stages.a[i]);
      drift(state, now, state.stages.b[i + 1]);
    }
    now.evaluated = false;
    return Outcome::ok;
  }

 private:
  /// Flow of H-bar_2(q~, t~, r), without its action on the clone's momentum.
  void drift(State& state, Iterate& now, double length) const {
    now.x += (length * h * family.kinetic(state.t_clone)) * state.r;
    state.t += length * h * family.monitor(state.t_clone);
  }

  /// Flow of H-bar_1(q, t, r~), without its action on the clone's position.
  void kick(State& state, Iterate& now, auto& f, double length) const {
    now.evaluate(f);
    state.r -= (length * h * family.potential(state.t)) * now.gradient;
    state.t_clone += length * h * family.monitor(state.t);
  }
};

}  // namespace experiment
