#pragma once
#include "avi/core/state.hpp"
#include "beyond/speed/work_precision/family.hpp"
#include "beyond/speed/work_precision/peers/peers.hpp"
#include "common/methods/method_of_orbit.hpp"
#include "common/reference.hpp"
#include "common/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

// A problem with its starts, from which scenes are made: our methods, the equations for others, and the
// reference.

namespace experiment::work_precision {

/// A problem H = |p|^2 / 2 + V(q) with unit masses.
template <class P>
concept UnitMasses = requires(P problem, avi::Vector<double, P::dimension> z) {
  problem.potential_gradient(z);
  requires !requires { problem.velocity(z); };
};

template <class P>
struct Arena {
  static constexpr int n = P::dimension;
  P problem;
  double horizon;
  std::array<avi::State<n>, starts> start;

  /// The start and four neighbours, whose first coordinate is moved by -2e-14 ... 2e-14.
  Arena(P problem_, double horizon_, const avi::State<n>& middle)
      : problem(std::move(problem_)), horizon(horizon_) {
    for (int k = 0; k < starts; ++k) {
      start[k] = middle;
      start[k].q[0] += (k - starts / 2) * 1e-14;
    }
  }

  [[nodiscard]] const avi::State<n>& at(int k) const { return start[k]; }

  /// Adds a family of methods: make(problem, start) returns a new method, and the setting is its step size.
  template <class Make>
  void add(Scene& scene, Origin origin, std::string method, int order, std::string knob,
           std::vector<double> settings, Make make) const {
    const MethodOf<n> runner(problem, [its = problem, make](const auto& z) { return make(its, z); });
    scene.families.push_back(
        {std::move(method), order, origin, std::move(knob), std::move(settings),
         [arena = *this, runner](const Request& request) { return arena.run(request, runner); }});
  }

  /// The problem as y' = f(y) with y = (q, p).
  [[nodiscard]] Equations equations() const {
    const auto energy = [its = problem](const double* y) {
      const Eigen::Map<const avi::Vector<double, n>> q(y), p(y + n);
      return its(q, p);
    };
    Equations made{horizon, std::make_shared<P>(problem), &field, energy};
    for (const auto& z : start) {
      made.start.emplace_back(z.q.begin(), z.q.end());
      made.start.back().insert(made.start.back().end(), z.p.begin(), z.p.end());
    }
    return made;
  }

  /// The right-hand side f, for Equations.
  static int field(double, const double* y, double* f, void* self) {
    auto& counted = *static_cast<RightHandSide*>(self);
    ++counted.evaluations;
    const P& its = *static_cast<const P*>(counted.problem);
    if constexpr (requires { its.rates(y, f); }) {
      its.rates(y, f);
      return 0;
    } else {
      return field_of(its, y, f);
    }
  }

 private:
  /// The right-hand side f, from the derivatives that P provides.
  static int field_of(const P& its, const double* y, double* f) {
    using Vec = avi::Vector<double, n>;
    const Vec q = Eigen::Map<const Vec>(y);
    if constexpr (UnitMasses<P>) {
      // Written entry by entry: reading a whole vector just after its entries were written would make GSL
      // 40 % slower.
      const Vec slope = its.potential_gradient(q);
      for (int i = 0; i < n; ++i) {
        f[i] = y[n + i];
        f[n + i] = -slope[i];
      }
    } else {
      const Vec p = Eigen::Map<const Vec>(y + n);
      Eigen::Map<Vec> velocity(f), force(f + n);
      velocity = its.d_dp(q, p);
      force = -its.d_dq(q, p);
    }
    return 0;
  }

  /// One run of one of our methods, according to a request.
  [[nodiscard]] Result run(const Request& request, const MethodOf<n>& runner) const {
    const avi::Until until{.time = horizon, .steps = request.step_cap};
    const avi::State<n>& begin = at(request.start);
    avi::State<n> z = begin;
    avi::Run run;
    avi::AnyMethod<n> method = runner.make(begin);
    Result result;
    if (request.watch_energy) {
      const double energy = runner.energy(begin);
      run = avi::integrate(method, z, request.setting, until, [&](const avi::State<n>& s, long) {
        result.energy_error = std::max(result.energy_error, std::abs(runner.energy(s) - energy));
      });
    } else {
      // A method that has already run starts with what it has learnt, so the result of the first run counts.
      bool anew = true;
      result.seconds = block_seconds(
          [&] {
            avi::State<n> moved = begin;
            const avi::Run made = avi::integrate(method, moved, request.setting, until);
            if (std::exchange(anew, false)) z = moved, run = made;
          },
          request.repeats);
    }
    result.ok = run.outcome == avi::Outcome::ok;
    result.q = z.q;
    result.t = z.t;
    result.steps = run.steps;
    result.evaluations = run.evaluations;
    return result;
  }
};

/// Sets a reference solution in extended precision. make(start, fraction) returns a run with this fraction of
/// its step; its run_to(horizon) comes close to the horizon, and its position(t) is the position at a later
/// time t. There is one for each start, made when it is first needed. Its error is estimated as the
/// difference from a run with two thirds of the step.
template <class P, class Make>
void set_reference(Scene& scene, const Arena<P>& arena, Make make) {
  using Run = decltype(make(arena.at(0), 1.0L));
  const auto reached = [=](int k, long double fraction) {
    auto run = std::make_shared<Run>(make(arena.at(k), fraction));
    run->run_to(arena.horizon);
    return run;
  };
  auto runs = std::make_shared<std::map<int, std::shared_ptr<Run>>>();
  scene.position_error = [=](int k, double t, const Eigen::VectorXd& q) {
    auto& run = (*runs)[k];
    if (!run) run = reached(k, 1.0L);
    return (run->position(t) - q).norm();
  };
  scene.reference_error =
      scene.position_error(0, arena.horizon, reached(0, 1.0L / 1.5L)->position(arena.horizon));
}

/// The same by the composition of order 10, with step h. @param log_form whether h is a step in the time of
/// the logarithmic Hamiltonian
template <class P>
void set_extended_reference(Scene& scene, const Arena<P>& arena, bool log_form, long double h) {
  set_reference(scene, arena,
                [=, problem = arena.problem](const avi::State<P::dimension>& start, long double fraction) {
                  return ExtendedRun<P>(problem, start, log_form, fraction * h);
                });
}

}  // namespace experiment::work_precision
