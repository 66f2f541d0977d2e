#pragma once
#include "avi/core/bracketed_root.hpp"
#include "avi/core/require.hpp"
#include "avi/core/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// States inside a step from the polynomial of the method, without an evaluation.

namespace avi {

/// The state at physical time t inside the last step of a method that has a polynomial (HTVI, collocation),
/// without any further evaluation. The polynomial is shifted linearly so that it begins at `before` and ends
/// at `after`: over a run the output is continuous. Its error is O(h^(r+1)) for a Taylor polynomial of order
/// r; Step::locate() costs some steps and is as accurate as the run.
/// @param method one that has just stepped from `before` to `after`
/// @param t between the two ends of that step
/// @throws std::invalid_argument when t lies outside the step, or strictly inside one that is not the last
/// step of the method.
template <class M, class State>
[[nodiscard]] State dense_output(const M& method, const State& before, const State& after, double t) {
  static_assert(
      requires { method.polynomial(0.0, 0.0); },
      "Dense output needs a method with a polynomial; at_times() serves every method.");
  const auto [first, last] = std::minmax(before.t, after.t);
  require(t >= first && t <= last, "Time of dense output", t, "in the last step, [", first, ", ", last, "]");
  if (t == before.t) return before;
  if (t == after.t) return after;
  const State begin = method.polynomial(0.0, before.t), end = method.polynomial(1.0, before.t);
  // The curve of an HTVI is the step to the bit only at one end of q and, to what its solver leaves, at the
  // other one of p.
  const auto is_near = [](const auto& x, const auto& y, double tolerance) {
    return largest_entry(x - y) <= tolerance * (largest_entry(x) + largest_entry(y));
  };
  constexpr double loose = 1e-3;
  require((is_near(begin.q, before.q, 0.0) && is_near(end.p, after.p, loose)) ||
              (is_near(begin.p, before.p, 0.0) && is_near(end.q, after.q, loose)),
          "Last step of the method of dense output", "another one", "that from `before` to `after`");
  const auto at = [&](double c) {
    State z = method.polynomial(c, before.t);
    z.q += (1.0 - c) * (before.q - begin.q) + c * (after.q - end.q);
    z.p += (1.0 - c) * (before.p - begin.p) + c * (after.p - end.p);
    z.t += (1.0 - c) * (before.t - begin.t) + c * (after.t - end.t);
    return z;
  };
  const double sense = std::copysign(1.0, after.t - before.t);
  const double c =
      bracketed_root([&](double x) { return sense * (at(x).t - t); }, 0.0, sense * (before.t - t), 1.0,
                     sense * (after.t - t), std::numeric_limits<double>::epsilon() * std::abs(t))
          .x;
  State z = at(c);
  z.t = t;  // the clock of the polynomial is off by rounding
  return z;
}

/// The same inside a step that an observer is shown.
template <class M, class State>
[[nodiscard]] State dense_output(const Step<M, State>& step, double t) {
  return dense_output(step.method, step.before, step.after, t);
}

}  // namespace avi
