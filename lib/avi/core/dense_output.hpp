#pragma once
#include "avi/core/bracketed_root.hpp"
#include "avi/core/require.hpp"
#include "avi/core/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// dense_output(): states inside a step from the polynomial of the method, without further evaluations.

namespace avi {

/// The state at physical time t inside the last step, for methods that provide a polynomial (HTVI,
/// collocation); it needs no further evaluation. A linear shift makes the polynomial begin at `before` and
/// end at `after`, so that the output is continuous over a run. Its error is O(h^(r+1)) for a Taylor
/// polynomial of order r. Step::locate() costs several steps instead but is as accurate as the run.
/// @param method must have just stepped from `before` to `after`
/// @param t a time in that step
/// @throws std::invalid_argument for t outside the step, or strictly inside a step that is not the last one
/// of the method.
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
  // The curve of an HTVI equals the step exactly at one end of q only; at the opposite end of p it agrees up
  // to the residual of the solver. (For Type III, q and p change roles.)
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
  z.t = t;  // rounding makes the time of the polynomial slightly different
  return z;
}

/// The same inside a step that an observer receives.
template <class M, class State>
[[nodiscard]] State dense_output(const Step<M, State>& step, double t) {
  return dense_output(step.method, step.before, step.after, t);
}

}  // namespace avi
