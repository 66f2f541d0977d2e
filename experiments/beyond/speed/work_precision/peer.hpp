#pragma once
#include "beyond/speed/work_precision/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Adapters shared by the integrators of other libraries: they see y = (q, p), y' = f(y) and a tolerance that
/// is both relative and absolute.

namespace experiment::work_precision {

/// q' = p (or velocity(p)), p' = -dV/dq.
template <class P>
struct FirstOrder {
  static constexpr int n = P::dimension;
  P problem;
  long evaluations = 0;

  explicit FirstOrder(P problem_) : problem(std::move(problem_)) {}

  void operator()(const double* y, double* f) {
    const avi::Vector<double, n> q = Eigen::Map<const avi::Vector<double, n>>(y);
    const avi::Vector<double, n> force = problem.potential_gradient(q);
    for (int i = 0; i < n; ++i) {
      f[i] = y[n + i];  // unit masses
      f[n + i] = -force[i];
    }
    ++evaluations;
  }
};

struct PeerEnd {
  bool ok = false;
  long steps = 0;
  long evaluations = 0;
};

/// make(problem, tolerance, step_cap) gives solve(y, t0, horizon, watch) -> PeerEnd, which calls watch(y)
/// after every step. Allocation of the library's workspace counts as set-up only where the library allows it.
template <class P, class Make>
Family peer(const Arena<P>& arena, std::string method, int order, Make make) {
  Family family{
      std::move(method), order, Origin::peer, "tolerance", geometric(1e-2, std::pow(0.1, 0.5), 29), {}};
  family.run = [arena, make](const Request& request) {
    constexpr int n = P::dimension;
    const auto& start = arena.at(request.start);
    const auto solve = make(arena.problem, request.setting, request.step_cap);
    std::vector<double> y(2 * n);
    const auto reset = [&] {
      for (int i = 0; i < n; ++i) {
        y[static_cast<std::size_t>(i)] = start.q[i];
        y[static_cast<std::size_t>(n + i)] = start.p[i];
      }
    };
    PeerEnd end;
    Result result;
    reset();
    if (request.watch_energy) {
      const double energy = arena.problem(start.q, start.p);
      end = solve(std::span<double>(y), 0.0, arena.horizon, [&](std::span<const double> now) {
        const Eigen::Map<const avi::Vector<double, n>> q(now.data()), p(now.data() + n);
        result.energy_error = std::max(result.energy_error, std::abs(arena.problem(q, p) - energy));
      });
    } else {
      result.seconds = block_seconds(
          [&] {
            reset();
            end = solve(std::span<double>(y), 0.0, arena.horizon, [](std::span<const double>) {});
          },
          request.repeats);
    }
    result.ok = end.ok;
    result.q = Eigen::Map<const avi::Vector<double, n>>(y.data());
    result.t = arena.horizon;
    result.steps = end.steps;
    result.evaluations = end.evaluations;
    return result;
  };
  return family;
}

}  // namespace experiment::work_precision
