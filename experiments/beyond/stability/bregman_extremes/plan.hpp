#pragma once
#include "beyond/stability/bregman_extremes/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

/// @file
/// Which minimisations are made.

namespace experiment {

/// How long the experiment may take.
enum class Effort { quick, usual, extreme };

inline constexpr const char* bregman_methods[] = {"htvi",     "heavy_ball", "splitting",    "clone_strang",
                                                  "clone_y4", "clone_y6",   "runge_kutta_4"};

/// Every method, p to 50, p_ring to 1e-6: P = p^2/p_ring to 2.5e9.
inline void add_orders(std::vector<Scene>& all, Effort effort) {
  for (const char* method : bregman_methods)
    for (double p : {1.0, 2.0, 4.0, 10.0, 20.0, 50.0})
      for (double p_ring : std::set{p, 1.0, 1e-3, 1e-6}) {
        if (p_ring > p) continue;
        Scene s{.scene = "order", .method = method, .p = p, .p_ring = p_ring};
        // Low orders need more iterations than a figure is worth.
        s.cap = effort == Effort::quick ? 1000 : p * p / p_ring < 10.0 ? 5000 : 25'000;
        all.push_back(s);
      }
}

/// Correlations to 1 - 1e-8.
inline void add_conditions(std::vector<Scene>& all, Scene s) {
  s.scene = "conditioning";
  for (int k = 1; k <= 8; ++k) {
    s.rho = 1.0 - std::pow(10.0, -k);
    all.push_back(s);
  }
}

/// Dimensions to 1e6, or 1e7 with Effort::extreme; large ones under a cap on the entries moved.
inline void add_dimensions(std::vector<Scene>& all, Scene s, Effort effort) {
  s.scene = "dimension";
  const long largest = effort == Effort::extreme ? 10'000'000 : effort == Effort::usual ? 1'000'000 : 10'000;
  for (long n :
       {1L, 2L, 5L, 10L, 20L, 50L, 100L, 200L, 500L, 1000L, 10'000L, 100'000L, 1'000'000L, 10'000'000L}) {
    if (n > largest) break;
    const long usual = n > 200 ? 4'000'000 : 20'000'000;
    const long entries = effort == Effort::extreme ? 1'000'000'000
                         : effort == Effort::usual ? usual
                                                   : 200'000;
    s.dimension = n;
    s.cap = std::clamp(entries / n, 10L, 400'000L);
    all.push_back(s);
  }
}

/// Starts from 1e-6 to 1e6 away: as they are, and with C away^2 and r0 / away kept, as f is homogeneous; then
/// far starts make the run of a near one, to a relatively smaller delta.
inline void add_starts(std::vector<Scene>& all, const Scene& base) {
  for (int k = -6; k <= 6; ++k) {
    Scene s = base;
    s.scene = "start";
    s.away = std::pow(10.0, k);
    all.push_back(s);
    s.scene = "start_scaled";
    s.C *= 16.0 / (s.away * s.away);
    s.from.momentum = s.away / 4.0;
    all.push_back(s);
  }
}

/// Start times and steps that no one would choose.
inline void add_clocks_and_steps(std::vector<Scene>& all, const Scene& base) {
  for (double t : {1e-6, 1e-3, 1e3, 1e6, 1e30, 1e100}) {
    Scene s = base;
    s.scene = "clock";
    s.from = {.t = t, .momentum = 0.0};
    all.push_back(s);
  }
  for (double h : {1e-300, 1e-20, 1.0, 1e20, 1e300}) {
    Scene s = base;
    s.scene = "step";
    s.h = h;
    all.push_back(s);
  }
}

/// All of them, in the order of the table.
inline std::vector<Scene> plan(Effort effort) {
  std::vector<Scene> all;
  add_orders(all, effort);
  for (const char* method : {"htvi", "heavy_ball"})
    for (double p : {4.0, 10.0}) {
      Scene base{.scene = "", .method = method, .p = p, .p_ring = p == 4.0 ? 1.0 : 0.5};
      base.cap = effort == Effort::quick ? 2000 : 100'000;
      add_conditions(all, base);
      add_dimensions(all, base, effort);
      add_starts(all, base);
      add_clocks_and_steps(all, base);
    }
  return all;
}

}  // namespace experiment
