#pragma once
#include "optimisers/table6_search/modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// Which settings of HTVI give a row of nine iteration counts.
//
// In the variables z = t^(p/2) (x - 1) and S = t^(p/2) R / sqrt(C) a step of eta = h p^2 / p_ring is
// autonomous,
//
//   S' = S - u grad f(z),  z' = z + u S',  z+ = z' e^(eta/2),  S+ = S' e^(-eta/2),  u = sqrt(C) eta,
//
// up to terms of the order eta / p and the slow change of eta by e^(-h k). Counts depend on u at the fifth
// digit, as phases of many turns do, and on eta at fixed u at the third. So a grid is fine in u, and one
// trajectory serves several eta: what depends on eta beside its small part in the motion is the scale of f =
// t^(-2p) f(z) and of its gradient, t^(-3p/2) grad f(z).

namespace experiment::table6_search {

constexpr int cells = 9;
using Counts = std::array<long, cells>;  ///< Updates until delta = 1e-2, ..., 1e-10.

/// The ranges of the search: ratios are steps of geometric grids.
struct Ranges {
  double u_low = 2e-4, u_high = 1.25e-3, u_ratio = 1.00001;
  double eta_low = 0.0038, eta_high = 0.0066;
  static constexpr double eta_ratio = 1.001;
  static constexpr int etas = 16;  ///< Values of eta that one trajectory serves.
};

/// The outcome of a run.
struct Variant {
  const char* name;
  Form form = Form::type_2;
  Test test = Test::both;
  double away = 4.0;      ///< Every entry of x_0 - 1.
  double momentum = 1.0;  ///< Every entry of r_0 t_0^(-p): of r_0 with t_0 = 1.
  bool loop = false;  ///< Temporal looping: t returns to 1 after some time, position and velocity are kept.
  double u_by = 1.0;  ///< Factor on the range of u: what oscillates more slowly is stable at a larger step.
};

/// A point of the grid and how many of the first cells it hits within `slack`.
struct Hit {
  double u = 0.0, eta = 0.0;
  int leading = 0;
};

struct Scan {
  double points = 0;
  std::array<double, cells + 1> with{};  ///< Points by how many leading cells they hit.
  Hit best;                              ///< The first of those with most.
};

constexpr long slack = 3;
constexpr double h = 2e-6;  ///< As printed.

/// True where the test for delta holds at an iterate: `change` is |f_k - f_{k-1}|.
inline bool holds(Test test, double change, double slope, double delta, double value_0, double slope_0) {
  if (test == Test::relative) return change < delta * value_0 && slope < delta * slope_0;
  return (test == Test::gradient || change < delta) && (test == Test::value || slope < delta);
}

/// Scans the ranges for some rows at once.
inline std::vector<Scan> scan(const Spectrum& of, const Variant& variant, const Ranges& ranges,
                              const std::vector<Counts>& wanted) {
  std::vector<Scan> results(wanted.size());
  const auto last_of = [&](int cell) {
    long last = 0;
    for (const Counts& row : wanted)
      last = std::max(last, row[cell] + slack);
    return last;
  };
  std::vector<double> spent(static_cast<std::size_t>(last_of(cells - 1)) + 2);  // t^(-theta), summed
  for (std::size_t k = 1; k < spent.size(); ++k)
    spent[k] = spent[k - 1] + std::exp(-h * static_cast<double>(k - 1));
  const double block = std::pow(Ranges::eta_ratio, Ranges::etas);
  std::vector<Lane> values, slopes;  // f(z) and |grad f(z)| of eight trajectories, step by step
  std::vector<std::array<std::array<long, Ranges::etas>, lanes>> passed(wanted.size());
  std::array<std::vector<double>, Ranges::etas> scale;  // from z_k to x_k - 1, for each eta
  for (std::vector<double>& each : scale)
    each.resize(spent.size());
  for (double low = ranges.eta_low; low < ranges.eta_high; low *= block) {
    const double middle = low * std::sqrt(block);
    std::array<double, Ranges::etas> etas{};
    for (int j = 0; j < Ranges::etas; ++j)
      etas[j] = low * std::pow(Ranges::eta_ratio, j + 0.5);
    // z_k is taken before its clock advances: its scale is that of t_{k-1}.
    for (int j = 0; j < Ranges::etas; ++j)
      for (std::size_t k = 0; k < spent.size(); ++k)
        scale[j][k] = k > 0 ? std::exp(-0.5 * etas[j] * spent[k - 1]) : 1.0;
    for (double first = ranges.u_low; first < ranges.u_high; first *= std::pow(ranges.u_ratio, lanes)) {
      Lane u;
      for (int l = 0; l < lanes; ++l)
        u.set(l, first * std::pow(ranges.u_ratio, l));
      State at;
      for (int i = 0; i < modes; ++i)
        at.z[i] = Lane(variant.away * of.ones[i]),
        at.s[i] = (variant.momentum * of.ones[i]) * (middle / u);  // R_0 / sqrt(C)
      const Lane form_0 = at.form(of);
      values.assign(1, form_0 * form_0);
      slopes.assign(1, at.slope(of, form_0));
      // Where a row's last cell was passed, for each trajectory and eta; -1 where one was missed.
      for (std::size_t r = 0; r < wanted.size(); ++r) {
        passed[r] = {};
        results[r].points += static_cast<double>(lanes) * Ranges::etas;
      }
      bool alive = true;
      for (int cell = 0; cell < cells && alive; ++cell) {
        const double delta = std::pow(10.0, -2 - cell);
        for (long k = std::ssize(values); k <= last_of(cell); ++k) {
          const double shrink = std::exp(-h * static_cast<double>(k - 1));
          const double grow = std::exp(0.5 * middle * shrink), fall = 1.0 / grow;
          step(of, variant.form, at, u * shrink, u * shrink);
          const Lane form = at.form(of);
          values.push_back(form * form);
          slopes.push_back(at.slope(of, form));
          for (int i = 0; i < modes; ++i)
            at.z[i] *= grow, at.s[i] *= fall;
        }
        alive = false;
        for (std::size_t r = 0; r < wanted.size(); ++r)
          for (int l = 0; l < lanes; ++l)
            for (int j = 0; j < Ranges::etas; ++j) {
              long& from = passed[r][l][j];
              if (from < 0) continue;
              const auto hold = [&](long k) {
                const double at_k = scale[j][k], before = scale[j][k - 1];
                const double f = values[k][l] * at_k * at_k * at_k * at_k,
                             f_before = values[k - 1][l] * before * before * before * before;
                return holds(variant.test, std::abs(f - f_before), slopes[k][l] * at_k * at_k * at_k, delta,
                             values[0][l], slopes[0][l]);
              };
              const long begin = std::max({wanted[r][cell] - slack, from, 1L}), end = wanted[r][cell] + slack;
              long found = 0;
              for (long k = begin; k <= end && !found; ++k)
                if (hold(k)) found = k;
              for (long k = begin - 1; found && k >= std::max(from, 1L); --k)
                if (hold(k)) found = 0;
              from = found ? found : -1;
              if (!found) continue;
              alive = true;
              results[r].with[cell + 1] += 1;
              if (cell + 1 > results[r].best.leading) results[r].best = {u[l], etas[j], cell + 1};
            }
      }
    }
  }
  return results;
}

/// The counts of one run in the variables of the paper, with p and p_ring = p^2 h / eta: no scaling, no grid.
/// A cell that is not reached within `cap` updates has 0. Where t passes `t_turn`, it is set to 1.
inline Counts exact_counts(const Spectrum& of, const Variant& variant, double p, double u, double eta,
                           long cap = 12000, double t_turn = HUGE_VAL) {
  const double theta = p * h / eta;  // p_ring / p with p^2 / p_ring = eta / h
  const double C = (u / eta) * (u / eta);
  double t = 1.0;
  State at;
  for (int i = 0; i < modes; ++i)
    at.z[i] = Lane(variant.away * of.ones[i]), at.s[i] = Lane(variant.momentum * of.ones[i]);
  const double form_0 = at.form(of)[0], slope_0 = at.slope(of, Lane(form_0))[0];
  double before = form_0 * form_0;
  Counts made{};
  int cell = 0;
  for (long k = 1; k <= cap && cell < cells; ++k) {
    const double now = eta * std::pow(t, -theta);
    step(of, variant.form, at, Lane(now * C * std::pow(t, p)), Lane(now));
    const double next = t * (1.0 + now / p);
    const double fall = std::pow(t / next, p);
    for (int i = 0; i < modes; ++i)
      at.s[i] *= fall;
    t = next > t_turn ? 1.0 : next;
    const Lane form = at.form(of);
    const double value = form[0] * form[0], slope = at.slope(of, form)[0];
    if (!std::isfinite(value)) break;
    while (cell < cells && holds(variant.test, std::abs(value - before), slope, std::pow(10.0, -2 - cell),
                                 form_0 * form_0, slope_0))
      made[cell++] = k;
    before = value;
  }
  return made;
}

}  // namespace experiment::table6_search
