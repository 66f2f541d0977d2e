#pragma once
#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// @file
/// What an HTVI step can do without, and what it costs with it. Not by Runner, the handle of other
/// experiments: time as a coordinate, observers of steps, dense output and landings are what it leaves out,
/// and in it they would be compiled for every method of every program.

namespace experiment {

/// A run with one optional part, beside the same run without.
struct Part {
  std::string name, without;  ///< Its own and that of the run it is compared with; equal for a bare one.
  int order;                  ///< Of the method.
  long steps, evaluations;    ///< Of the run.
  std::function<void()> run;  ///< What is timed.
};

constexpr long part_steps = 200;
constexpr double part_h = 0.1;

/// The start of every run: e = 0.9.
inline avi::State<2> part_start() { return avi::Kepler::pericentre(0.9); }
/// The monitor of every run, where it has one: that of Table 1.
inline auto part_monitor() { return avi::bounded(avi::NormSquared{}, 0.01, 8.0); }

/// The stationary HTVI of an order, chosen at run time.
template <avi::Generating type = avi::Generating::type2, class Problem>
auto part_method(int order, const Problem& problem) {
  return avi::htvi_of_order<type>(order / 2 - 1, problem, avi::gauss(order / 2));
}

/// A run of `steps` steps by `method` from `start`.
template <class Method, class State, class... Observer>
Part part(std::string name, std::string without, int order, const Method& method, const State& start,
          double h = part_h, Observer... observer) {
  const auto shared = std::make_shared<Method>(method);
  const auto run = [=] {
    State z = start;
    return avi::integrate(*shared, z, h, {.steps = part_steps}, observer...);
  };
  const avi::Run done = run();
  return {std::move(name), std::move(without), order, done.steps, done.evaluations, [=] { (void)run(); }};
}

/// The bare run of an order, the paper's constructions, Type III, time as a coordinate.
std::vector<Part> parts_of_construction(int order);
/// Observer, dense output, landings.
std::vector<Part> parts_of_output(int order);
/// Monitors and gradients.
std::vector<Part> parts_of_problem(int order);
/// What an order known to the compiler saves.
std::vector<Part> parts_at_compile_time(int order);

}  // namespace experiment
