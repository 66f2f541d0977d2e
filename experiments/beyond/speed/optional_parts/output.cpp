#include "beyond/speed/optional_parts/parts.hpp"

#include "avi/core/dense_output.hpp"
#include "avi/core/integrate_to.hpp"

#include <cmath>

namespace experiment {

std::vector<Part> parts_of_output(int order) {
  const avi::State<2> start = part_start();
  const auto method = part_method(order, avi::poincare<2>(avi::Kepler{}, start, part_monitor()));
  const auto shared = std::make_shared<std::decay_t<decltype(method)>>(method);
  std::vector<Part> parts;
  const auto worst = std::make_shared<double>(0.0);
  parts.push_back(part("observer: energy each step", "bare", order, method, start, part_h,
                       [=](const avi::State<2>& z, long) {
                         *worst = std::max(*worst, std::abs(avi::Kepler{}(z.q, z.p) + 0.5));
                       }));

  // A state inside every step.
  const auto dense = [=] {
    avi::State<2> z = start;
    double sum = 0.0;
    const auto look = [&]<class M>(const avi::Step<M, avi::State<2>>& step, long) {
      sum += avi::dense_output(step, 0.5 * (step.before.t + step.after.t)).q[0];
    };
    const avi::Run run = avi::integrate(*shared, z, part_h, {.steps = part_steps}, look);
    *worst = sum;
    return run;
  };
  const avi::Run done = dense();
  parts.push_back(
      {"dense output in each step", "bare", order, done.steps, done.evaluations, [=] { (void)dense(); }});

  // Ten requested times on the way; each adds a shortened step and the search for it.
  avi::State<2> z = start;
  (void)avi::integrate(*shared, z, part_h, {.steps = part_steps});
  const double end = z.t;
  const auto landings = [=] {
    avi::State<2> moved = start;
    avi::Run total;
    for (int k = 1; k <= 10; ++k) {
      const avi::Run run = avi::integrate_to(*shared, moved, part_h, 0.1 * k * end);
      total.steps += run.steps;
      total.evaluations += run.evaluations;
    }
    return total;
  };
  const avi::Run landed = landings();
  parts.push_back({"landing at 10 times in 200 steps", "bare", order, landed.steps, landed.evaluations,
                   [=] { (void)landings(); }});
  return parts;
}

}  // namespace experiment
