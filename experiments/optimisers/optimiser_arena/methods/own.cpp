#include "avi/bregman/bregman_htvi.hpp"
#include "avi/bregman/bregman_restarted.hpp"
#include "avi/optim/minimise.hpp"
#include "optimisers/optimiser_arena/meter.hpp"

namespace arena {
namespace {

std::function<void(Meter&)> minimise_with(int memory) {
  return [memory](Meter& meter) {
    (void)avi::minimise(
        objective_of(meter), meter.x0,
        {.relative = tolerances.back(), .memory = memory, .callback = [&](const avi::Progress& at) {
           meter.iterations = at.iterations;
           return true;
         }});
  };
}

/// The paper's Adaptive method at p = 4, p_ring = 1, its fictive step such that the first update is a given
/// part of the start's size: the paper tunes h for its one problem.
std::function<void(Meter&)> bregman_with(double part) {
  return [part](Meter& meter) {
    VectorX g(meter.x0.size());
    const double value = meter(meter.x0, g);
    const auto family = avi::BregmanFamily::adaptive(4.0, 1.0);
    const double h = std::sqrt(100.0 * part * first_length(meter.x0, g, value) / family.C) / family.order();
    follow(meter, avi::BregmanHtvi{.family = family, .h = h, .from = {.momentum = 0.0}});
  };
}

}  // namespace

std::vector<Method> all_methods() {
  Method paper{.name = "bregman_htvi", .runs = {}, .slow = true};
  for (double part : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1})
    paper.runs.push_back(bregman_with(part));
  std::vector<Method> all{
      {"minimise_m0", {minimise_with(0)}},
      {"minimise_m7", {minimise_with(7)}},
      {"bregman_restarted", {[](Meter& meter) { follow(meter, avi::BregmanRestarted{}); }}},
      paper};
  for (const auto& others : {first_order_methods(), conjugate_gradients(), library_methods()})
    all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace arena
