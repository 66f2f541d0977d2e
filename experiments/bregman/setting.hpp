#pragma once
#include "common/problems/correlated_quartic.hpp"
#include "common/rules/rules.hpp"

#include <algorithm>
#include <string>
#include <vector>

// The runs of the paper's optimisation tables: settings, each typed once, and how to make them.

namespace experiment {

/// One run of a symplectic method on Bregman dynamics.
struct Setting {
  std::string method;  ///< htvi, splitting, clone_strang, clone_y4 or clone_y6.
  double p;
  double p_ring;                         ///< Equal to p for the Direct approach.
  double h;                              ///< Fictive step.
  avi::Clock clock = avi::Clock::euler;  ///< Clock of htvi.

  bool operator==(const Setting&) const = default;
  [[nodiscard]] bool is_direct() const { return p_ring == p; }
  /// p_ring as it stands in the tables: NaN for the Direct approach.
  [[nodiscard]] double p_ring_or_nan() const { return is_direct() ? std::nan("") : p_ring; }
  [[nodiscard]] std::string approach() const { return is_direct() ? "direct" : "adaptive"; }
  [[nodiscard]] avi::BregmanFamily family() const { return avi::BregmanFamily::adaptive(p, p_ring); }
};

inline Setting direct(std::string method, double p, double h) { return {std::move(method), p, p, h}; }

/// Minimises f from x0 with a setting's method.
inline avi::Minimisation run_setting(const Setting& s, const AnyObjective& f, const avi::VectorX& x0,
                                     const avi::Stopping& stopping = {}, const AnyWitness& witness = {}) {
  return run_updates({.method = s.method, .family = s.family(), .h = s.h, .clock = s.clock}, f, x0, stopping,
                     witness);
}

/// Table "Comparison of the Direct and Adaptive approach".
inline std::vector<Setting> direct_vs_adaptive_settings() {
  return {direct("htvi", 4, 8e-4),        {"htvi", 4, 0.5, 1.21e-4},     direct("htvi", 10, 4e-4),
          {"htvi", 10, 0.5, 1.95e-5},     direct("clone_y4", 4, 9e-4),   {"clone_y4", 4, 0.5, 1.15e-4},
          direct("clone_y4", 10, 3.3e-4), {"clone_y4", 10, 0.5, 1.62e-5}};
}

/// Table "Number of iterations needed until convergence of the different symplectic integrators". The printed
/// step 2.9e-4 of the adaptive cloning with Yoshida 4 diverges; 2.2e-4 gives the printed count. Both are
/// here.
inline std::vector<Setting> method_comparison_settings() {
  return {direct("htvi", 4, 8.7e-4),         {"htvi", 4, 1, 2.4e-4},
          direct("splitting", 4, 9.5e-4),    {"splitting", 4, 1, 2.9e-4},
          direct("clone_strang", 4, 9.7e-4), {"clone_strang", 4, 1, 2.4e-4},
          direct("clone_y4", 4, 8.9e-4),     {"clone_y4", 4, 1, 2.9e-4},
          {"clone_y4", 4, 1, 2.2e-4},        direct("clone_y6", 4, 7.9e-4),
          {"clone_y6", 4, 1, 2e-4}};
}

/// Table "Evolution of the fictive time-step and number of iterations".
inline std::vector<Setting> p_dependence_settings() {
  return {{"htvi", 2, 1, 8e-4},   {"htvi", 4, 2, 3.8e-4},   {"htvi", 4, 1, 2.4e-4},  {"htvi", 6, 1, 9.4e-5},
          {"htvi", 8, 1, 6.1e-5}, {"htvi", 4, 0.5, 1.2e-4}, {"htvi", 4, 0.1, 2.4e-5}};
}

/// Every setting of the three tables once, without the one that diverges.
inline std::vector<Setting> all_settings() {
  std::vector<Setting> all;
  for (const auto& table :
       {direct_vs_adaptive_settings(), method_comparison_settings(), p_dependence_settings()})
    for (const auto& s : table)
      if (s != Setting{"clone_y4", 4, 1, 2.9e-4} && std::find(all.begin(), all.end(), s) == all.end())
        all.push_back(s);
  return all;
}

}  // namespace experiment
