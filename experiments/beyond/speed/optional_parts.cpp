#include "common/frame.hpp"
#include "common/timing.hpp"

#include "avi/core/dense_output.hpp"
#include "avi/core/integrate.hpp"
#include "avi/core/integrate_to.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/time_dependent.hpp"
#include "common/methods/printed_htvi.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

// What every optional part of an HTVI step costs, as a ratio to the same run without it. Not by Method2, the
// handle of other experiments: time as a coordinate, observers of steps, dense output and landings are what
// it leaves out, and in it they would be compiled for every method of every program.

namespace {

using namespace experiment;
using avi::Kepler;

/// A run with one optional part.
struct Part {
  std::string name;
  long steps, evaluations;       ///< Of the run.
  std::function<void()> run;     ///< What is timed.
  std::string without = "bare";  ///< The run it is compared with.
};

constexpr long part_steps = 200;
constexpr double part_h = 0.1;

/// The stationary HTVI of an order, chosen at run time.
template <avi::Generating type = avi::Generating::type2, class Problem>
auto method_of(int order, const Problem& problem) {
  return avi::htvi_of_order<type>(order / 2 - 1, problem, avi::gauss(order / 2));
}

/// A part from run(), which makes the run.
template <class Run>
Part part(std::string name, const Run& run) {
  const avi::Run done = run();
  return {std::move(name), done.steps, done.evaluations, [=] { (void)run(); }};
}

/// A run of `part_steps` steps by `method` from `start`.
template <class Method, class State, class... Observer>
Part part(std::string name, const Method& method, const State& start, double h = part_h,
          Observer... observer) {
  const auto shared = std::make_shared<Method>(method);
  return part(std::move(name), [=] {
    State z = start;
    return avi::integrate(*shared, z, h, {.steps = part_steps}, observer...);
  });
}

/// All parts at an order, 4 or 8, from the pericentre of e = 0.9, most with the monitor of Table 1.
std::vector<Part> parts_of(int order) {
  const Kepler kepler;
  const avi::State<2> start = Kepler::pericentre(0.9);
  const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  const auto problem = avi::poincare<2>(kepler, start, monitor);
  const auto bare = method_of(order, problem);
  std::vector<Part> parts{part("bare", bare, start)};
  const auto add = [&](auto&&... what) { parts.push_back(part(what...)); };

  // The paper's constructions, Type III, time as a coordinate.
  const auto constructed = [&]<class Construction>() {
    return avi::htvi_of_order<avi::Generating::type2, Construction>(order - 1, problem,
                                                                    avi::gauss(order / 2));
  };
  add("as printed, of the same order", constructed.operator()<experiment::Printed>(), start);
  add("on the energy shell, of the same order", constructed.operator()<experiment::Authors>(), start);
  add("Type III", method_of<avi::Generating::type3>(order, problem), start);
  const auto in_time = avi::time_dependent(
      [](const auto& q, const auto&, const auto& p) { return Kepler{}(q, p); }, start, monitor);
  add("t and p^t as coordinates", method_of(order, in_time), avi::extended(in_time, start));
  parts.back().without = "automatic gradient";

  add("no monitor", method_of(order, avi::poincare<2>(kepler, start)), start, 0.0025);
  const auto momentum = avi::bounded(avi::Energy<Kepler>{kepler, 0.5}, 1e-4, 2.0);
  add("monitor of q and p", method_of(order, avi::poincare<2>(kepler, start, momentum)), start);
  const avi::Automatic<Kepler> automatic{kepler};
  add("automatic gradient", method_of(order, avi::poincare<2>(automatic, start, monitor)), start);

  const auto worst = std::make_shared<double>(0.0);
  add("observer: energy each step", bare, start, part_h,
      [=](const avi::State<2>& z, long) { *worst = std::max(*worst, std::abs(Kepler{}(z.q, z.p) + 0.5)); });
  const auto shared = std::make_shared<std::decay_t<decltype(bare)>>(bare);
  add("dense output in each step", [=] {
    avi::State<2> z = start;
    double sum = 0.0;
    const auto look = [&]<class M>(const avi::Step<M, avi::State<2>>& step, long) {
      sum += avi::dense_output(step, 0.5 * (step.before.t + step.after.t)).q[0];
    };
    const avi::Run run = avi::integrate(*shared, z, part_h, {.steps = part_steps}, look);
    *worst = sum;
    return run;
  });
  // Ten requested times on the way; each adds a shortened step and the search for it.
  avi::State<2> z = start;
  (void)avi::integrate(*shared, z, part_h, {.steps = part_steps});
  add("landing at 10 times in 200 steps", [=, end = z.t] {
    avi::State<2> moved = start;
    avi::Run total;
    for (int k = 1; k <= 10; ++k) {
      const avi::Run run = avi::integrate_to(*shared, moved, part_h, 0.1 * k * end);
      total.steps += run.steps;
      total.evaluations += run.evaluations;
    }
    return total;
  });

  const char* known = "order known to the compiler";
  order == 4 ? add(known, avi::htvi<4>(problem), start) : add(known, avi::htvi<8>(problem), start);
  return parts;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, AVI_SHOWS, [](Frame& frame) {
    Table table = frame.table({"part", "without", "order", "steps", "evaluations_per_step",
                               "seconds_per_step", "ratio_of_seconds"});
    table.note("problem", "Kepler, e = 0.9, from the pericentre; bounded monitor q^T q");
    table.note("bare",
               "Type II, stationary, with its Gauss rule, gradient supplied, order chosen at run time");
    table.note("ratio_of_seconds",
               "time per step over that of the run named in `without`, measured in turns");
    for (const int order : {4, 8}) {
      frame.progress("order " + std::to_string(order), order == 4 ? 0.0 : 0.5);
      const std::vector<Part> parts = parts_of(order);
      std::vector<std::function<void()>> works;
      for (const Part& part : parts)
        works.push_back(part.run);
      const auto seconds = interleaved_least_seconds(works, frame.quick ? 1 : 25);
      // Landings add steps of their own: every run is compared over the same 200.
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto other = std::ranges::find(parts, parts[i].without, &Part::name) - parts.begin();
        table.row(parts[i].name, parts[i].without, order, parts[i].steps,
                  1.0 * parts[i].evaluations / part_steps, rounded(seconds[i] / part_steps),
                  rounded(seconds[i] / seconds[other], 4));
      }
    }
    frame.write(table);
  });
}
