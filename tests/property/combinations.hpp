#pragma once
#include "avi/core/at_times.hpp"
#include "avi/core/integrate_to.hpp"
#include "avi/core/trajectory.hpp"
#include "avi/transform/time_dependent.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Every method x problem (autonomous, of time) x monitor (none, g(q), g(q, p), time in it) x what is done
// with a run: passing a time, landing on it, output at times, events, a stored trajectory, and
// the same backwards - each against GSL's rk8pd at a tolerance of 1e-13 in physical time, which knows of no
// monitor.
//
// Combinations that do not exist are refused by the compiler (tests/misuse):
//   a monitor of time with an autonomous problem        monitor_of_time.cpp
//   Euler-B with a monitor of p                          euler_b_with_monitor_of_momentum.cpp
//   splittings and Stormer-Verlet of a problem of time   splitting_of_time.cpp
//   Euler-B at a dimension known at run time only        euler_b_of_run_time_dimension.cpp
//   HTVI at such a dimension                             htvi_of_run_time_dimension.cpp
// Monitors belong to HTVI, collocation, Euler-B and the two controlled methods; the logarithmic Hamiltonian
// is its own.

namespace combinations {

using avi::State;

/// \f$H = p^2/2 + a(t)\,(q^2/2 + q^4/4)\f$, with a = 1 or a = 1 + 0.3 sin t.
inline double strength(double t, bool of_time) { return of_time ? 1.0 + 0.3 * std::sin(t) : 1.0; }

template <int n = 1>
struct QuarticOf {
  static constexpr int dimension = n;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return kinetic(p) + potential(q);
  }
  template <class P>
  static auto kinetic(const P& p) {
    return 0.5 * (p[0] * p[0]);
  }
  /// Less 10, so that it is negative where the logarithmic Hamiltonian needs it.
  template <class Q>
  static auto potential(const Q& q) {
    return 0.5 * (q[0] * q[0]) + 0.25 * (q[0] * q[0]) * (q[0] * q[0]) - 10.0;
  }
  template <class Q>
  static Q potential_gradient(const Q& q) {
    return Q(q + (q[0] * q[0]) * q);
  }
};

using Quartic = QuarticOf<>;

struct QuarticInTime {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S& t, const P& p) const {
    using std::sin;
    return 0.5 * (p[0] * p[0]) +
           (1.0 + 0.3 * sin(t)) * (0.5 * (q[0] * q[0]) + 0.25 * (q[0] * q[0]) * (q[0] * q[0]));
  }
};

// All near 1/2 to 1 on the orbit, so one step size serves all.
inline const auto of_q = [](const auto& q) { return 1.0 / (1.0 + 0.5 * (q[0] * q[0])); };
inline const auto of_qp = [](const auto& q, const auto& p) {
  return 1.0 / (1.0 + 0.3 * (q[0] * q[0]) + 0.2 * (p[0] * p[0]));
};
inline const auto of_qtp = [](const auto& q, const auto& t, const auto& p) {
  using std::cos;
  return (1.0 + 0.3 * cos(t)) / (1.0 + 0.3 * (q[0] * q[0]) + 0.2 * (p[0] * p[0]));
};

/// of_q with the rate of its inverse, for reversible control.
struct Controlled {
  double operator()(const auto& q, const auto&) const { return of_q(q); }
  double density_rate(const auto& q, const auto& p) const {
    return q[0] * p[0] / (1.0 + 0.5 * (q[0] * q[0]));  // -(dg/dq p) / g
  }
};

inline const State<1> start{.q = avi::Vector<double, 1>(0.9), .p = avi::Vector<double, 1>(0.4), .t = 0.5};
constexpr double horizon = 8.0;

/// The motion through `start`, by GSL.
inline State<1> exact(double t, bool of_time) {
  const auto field = [](double time, const double y[], double dy[], void* which) {
    const double a = strength(time, *static_cast<const bool*>(which));
    dy[0] = y[1];
    dy[1] = -a * (y[0] + y[0] * y[0] * y[0]);
    return static_cast<int>(GSL_SUCCESS);
  };
  gsl_odeiv2_system system{field, nullptr, 2, &of_time};
  const double h = t < start.t ? -1e-3 : 1e-3;
  gsl_odeiv2_driver* driver = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, h, 1e-13, 1e-13);
  double time = start.t, y[] = {start.q[0], start.p[0]};
  EXPECT_EQ(gsl_odeiv2_driver_apply(driver, &time, t, y), GSL_SUCCESS);
  gsl_odeiv2_driver_free(driver);
  return {.q = avi::Vector<double, 1>(y[0]), .p = avi::Vector<double, 1>(y[1]), .t = t};
}

/// How often p changes its sign on the way to time t.
inline int turns_until(double t, bool of_time) {
  int count = 0;
  double last = start.p[0];
  constexpr int samples = 200;  // half a period is about 2.5
  for (int k = 1; k <= samples; ++k) {
    const double p = exact(start.t + (t - start.t) * k / samples, of_time).p[0];
    count += p * last < 0.0;
    last = p;
  }
  return count;
}

inline State<1> plain(const State<1>& z) { return z; }
inline State<1> plain(const State<avi::dynamic>& z) {
  return {.q = z.q.head<1>(), .p = z.p.head<1>(), .t = z.t};
}
inline State<1> plain(const State<2>& bar) {
  EXPECT_LE(std::abs(bar.t - bar.q[1]), 1e-14) << "the clock";
  return avi::reduced(bar);
}

/// How far a state is from the exact one at its own time.
template <int n>
double error(const State<n>& z, bool of_time) {
  const State<1> here = plain(z), there = exact(here.t, of_time);
  double energy = 0.0;  // whose momentum, p^t, is minus H
  if constexpr (n == 2) energy = z.p[1] + QuarticInTime{}(there.q, there.t, there.p);
  return std::hypot(here.q[0] - there.q[0], here.p[0] - there.p[0], energy);
}

/// The largest errors of all that can be done with a run.
struct Worst {
  double state = 0.0;   ///< Of every state that a run shows or ends with, and of the times of events.
  double stored = 0.0;  ///< Of a stored trajectory between its states.
};

/// A method behind a type that knows only whether it has a memory: what is done with runs is compiled once
/// for all of them.
template <int n, bool without_memory>
class Erased {
 public:
  static constexpr bool one_step = without_memory;

  template <class M>
  requires(!std::is_same_v<M, Erased>) explicit Erased(M method)
      : held_(std::make_unique<Held<M>>(std::move(method))) {}
  Erased(const Erased& other) : held_(other.held_->copy()) {}
  Erased& operator=(Erased other) { return held_.swap(other.held_), *this; }
  avi::StepReport step(State<n>& z, double h) { return held_->step(z, h); }
  /// Of a problem of time, which sets the time among its coordinates.
  [[nodiscard]] const Erased& problem() const requires(n == 2) { return *this; }
  void set_time(State<n>& z, double t) const requires(n == 2) { held_->set_time(z, t); }

 private:
  struct Base {
    virtual ~Base() = default;
    [[nodiscard]] virtual std::unique_ptr<Base> copy() const = 0;
    virtual avi::StepReport step(State<n>& z, double h) = 0;
    virtual void set_time(State<n>& z, double t) const = 0;
  };
  template <class M>
  struct Held final : Base {
    explicit Held(M its) : method(std::move(its)) {}
    [[nodiscard]] std::unique_ptr<Base> copy() const override { return std::make_unique<Held>(method); }
    avi::StepReport step(State<n>& z, double h) override { return method.step(z, h); }
    void set_time(State<n>& z, double t) const override {
      if constexpr (n == 2)
        method.problem().set_time(z, t);
      else
        z.t = t;
    }
    M method;
  };
  std::unique_ptr<Base> held_;
};

template <class M, int n>
Worst use(const M& method, const State<n>& z0, double h) {
  Worst worst;
  const bool of_time = n == 2;
  const double sense = h > 0.0 ? 1.0 : -1.0, end = start.t + sense * horizon;
  const auto note = [&](const State<n>& z) { worst.state = std::max(worst.state, error(z, of_time)); };
  const auto carry_out = [&](auto&& run) {
    M fresh = method;
    State<n> z = z0;
    const avi::Run done = run(fresh, z);
    EXPECT_EQ(done.outcome, avi::Outcome::ok) << done.message;
    note(z);
    return z;
  };
  const avi::Event turning{[](const State<n>& z) { return z.p[0]; }};

  // Passing a time; on the way a stored trajectory, output at times and events.
  avi::Trajectory<n> path;
  std::vector<double> times;
  for (int k = 0; k <= 10; ++k)
    times.push_back(start.t + sense * 0.79 * k);
  std::size_t shown = 0;
  auto grid = avi::at_times(times, [&](const State<n>& z) {
    EXPECT_NEAR(z.t, times.at(shown++), 4e-15);
    note(z);
  });
  int turns = 0;
  auto watch = avi::on_event(turning, [&](const State<n>& z) {
    ++turns;
    EXPECT_LT(std::abs(z.p[0]), 1e-15);
    note(z);
  });
  const State<n> passed =
      carry_out([&](M& m, State<n>& z) { return avi::integrate(m, z, h, {.time = end}, path, grid, watch); });
  EXPECT_GE(sense * passed.t, sense * end);
  EXPECT_EQ(shown, times.size());
  EXPECT_EQ(turns, turns_until(plain(passed).t, of_time));
  worst.stored = error(path.at(start.t + sense * 3.3), of_time);

  // Landing on it, and on an event.
  EXPECT_NEAR(carry_out([&](M& m, State<n>& z) { return avi::integrate_to(m, z, h, end); }).t, end, 4e-15);
  const State<n> turned =
      carry_out([&](M& m, State<n>& z) { return avi::integrate_to(m, z, h, turning, {.time = end}); });
  EXPECT_LT(std::abs(turned.p[0]), 1e-15);
  return worst;
}

/// @param bound on the errors of states
template <class M, int n>
void check(const char* name, const M& its, const State<n>& z0, double step, double bound) {
  const Erased<n, avi::detail::one_step<M>> method(its);
  for (const double h : {step, -step}) {
    SCOPED_TRACE(std::string(name) + (h > 0.0 ? "" : ", backwards"));
    const Worst worst = use(method, z0, h);
    EXPECT_LT(worst.state, bound);
    EXPECT_LT(worst.stored, 1.1 * bound + 1e-5) << "eight states to a polynomial";
  }
}

}  // namespace combinations
