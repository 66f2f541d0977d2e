#include "avi/adaptive/euler_b.hpp"
#include "avi/adaptive/monitors.hpp"
#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/kepler.hpp"

#include <benchmark/benchmark.h>

#include <ctime>

/// Nanoseconds per step on Kepler's problem, e = 0.9, with the settings of Table 1; `in_verlet_steps` is the
/// ratio to a Stormer-Verlet step of the same run, which is measured first.

namespace {

constexpr double eccentricity = 0.9, horizon = 10.0;
double verlet_seconds = 0.0;  // per step

/// Whole runs, so that the states met are those of the orbit.
template <class Method>
void run(benchmark::State& bench, Method method, double h, bool reference = false) {
  long steps = 0;
  std::clock_t ticks = 0;  // processor time: the machine may have other work
  for (auto _ : bench) {
    auto z = avi::Kepler::pericentre(eccentricity);
    const std::clock_t start = std::clock();
    const avi::Run result = avi::integrate(method, z, h, {.time = horizon});
    ticks += std::clock() - start;
    if (result.outcome != avi::Outcome::ok) bench.SkipWithError(result.message.c_str());
    benchmark::DoNotOptimize(z);
    steps += result.steps;
  }
  const double each = static_cast<double>(ticks) / CLOCKS_PER_SEC / static_cast<double>(steps);
  if (reference) verlet_seconds = each;
  bench.counters["ns_per_step"] = 1e9 * each;
  bench.counters["in_verlet_steps"] = each / verlet_seconds;
}

void stormer_verlet(benchmark::State& bench) {
  run(bench, avi::stormer_verlet<2>(&avi::Kepler::potential_gradient<double>), 1e-3, true);
}

template <class G>
void euler_b(benchmark::State& bench, G monitor) {
  run(bench, avi::euler_b<2>(avi::Kepler{}, avi::Kepler::pericentre(eccentricity), monitor), 1e-3);
}

template <class H, class G>
void htvi4(benchmark::State& bench, H hamiltonian, G monitor, double h) {
  const auto problem = avi::poincare<2>(hamiltonian, avi::Kepler::pericentre(eccentricity), monitor);
  run(bench, avi::type2<3, avi::authors>(problem, avi::simpson()), h);
}

const avi::Kepler kepler;

BENCHMARK(stormer_verlet)->MinWarmUpTime(0.2);
BENCHMARK_CAPTURE(euler_b, none, avi::Unit{});
BENCHMARK_CAPTURE(euler_b, norm_squared, avi::NormSquared{});
BENCHMARK_CAPTURE(euler_b, arclength, avi::Arclength<avi::Kepler>{kepler, -0.5});
BENCHMARK_CAPTURE(htvi4, none, kepler, avi::Unit{}, 0.0025);
BENCHMARK_CAPTURE(htvi4, gamma, kepler, avi::bounded(avi::NormSquared{}, 0.01, 8.0), 0.1);
BENCHMARK_CAPTURE(htvi4, energy, kepler, avi::bounded(avi::Energy<avi::Kepler>{kepler, 0.5}, 1e-4, 2.0), 0.1);
BENCHMARK_CAPTURE(htvi4, arclength, kepler,
                  avi::bounded(avi::Arclength<avi::Kepler>{kepler, -0.5}, 0.03, 3.0), 0.1);
BENCHMARK_CAPTURE(htvi4, gamma_automatic_gradient, avi::Automatic<avi::Kepler>{kepler},
                  avi::bounded(avi::NormSquared{}, 0.01, 8.0), 0.1);

}  // namespace
