#include "optional/parts.hpp"

#include "avi/htvi/landing.hpp"

#include <cmath>

namespace experiment {

std::vector<Part> parts_of_output(int order) {
  const avi::State<2> start = part_start();
  const auto method = part_method<lean>(order, avi::poincare<2>(avi::Kepler{}, start, part_monitor()));
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
    double before = z.t, sum = 0.0;
    const avi::Run run =
        avi::integrate(*shared, z, part_h, {.steps = part_steps}, [&](const avi::State<2>& now, long) {
          const double middle = 0.5 * (before + now.t);
          sum += avi::dense_output(*shared, before, middle).q[0];
          before = now.t;
        });
    *worst = sum;
    return run;
  };
  const avi::Run done = dense();
  parts.push_back(
      {"dense output in each step", "bare", order, done.steps, done.evaluations, [=] { dense(); }});

  // Ten requested times on the way; each adds a shortened step and the search for it.
  avi::State<2> z = start;
  avi::integrate(*shared, z, part_h, {.steps = part_steps});
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
                   [=] { landings(); }});
  return parts;
}

}  // namespace experiment
