#pragma once
#include "avi/core/integrate.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/kepler.hpp"

#include <benchmark/benchmark.h>

#include <ctime>
#include <string>
#include <vector>

/// @file
/// Nanoseconds per step on Kepler's problem, e = 0.9; `in_verlet_steps` is the ratio to a Stormer-Verlet step
/// of the same run, which every program measures first.

namespace bench {

constexpr double eccentricity = 0.9, horizon = 10.0;
inline double verlet_seconds = 0.0;  // per step

inline avi::State<2> start() { return avi::Kepler::pericentre(eccentricity); }

/// Whole runs, so that the states met are those of the orbit.
template <class Method>
void run(benchmark::State& bench, Method method, double h, bool reference = false) {
  long steps = 0, evaluations = 0;
  std::clock_t ticks = 0;  // processor time: the machine may have other work
  for (auto _ : bench) {
    auto z = start();
    const std::clock_t begin = std::clock();
    const avi::Run result = avi::integrate(method, z, h, {.time = horizon});
    ticks += std::clock() - begin;
    if (result.outcome != avi::Outcome::ok) bench.SkipWithError(result.message.c_str());
    benchmark::DoNotOptimize(z);
    steps += result.steps;
    evaluations += result.evaluations;
  }
  const double count = static_cast<double>(steps);
  const double each = static_cast<double>(ticks) / CLOCKS_PER_SEC / count;
  if (reference) verlet_seconds = each;
  bench.counters["ns_per_step"] = 1e9 * each;
  bench.counters["in_verlet_steps"] = each / verlet_seconds;
  bench.counters["evaluations"] = static_cast<double>(evaluations) / count;
}

/// Registers a method made by `make` with step h.
template <class Make>
void add(const std::string& name, Make make, double h) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { run(state, make(), h); });
}

/// main() of a program: Stormer-Verlet, then what `register_all` adds.
template <class Register>
int main(int argc, char** argv, Register register_all) {
  benchmark::RegisterBenchmark("stormer_verlet", [](benchmark::State& state) {
    run(state, avi::stormer_verlet<2>(&avi::Kepler::potential_gradient<double>), 1e-3, true);
  })->MinWarmUpTime(0.2);
  register_all();
  // Long enough for two digits; what the command line says comes later and counts.
  std::string brief = "--benchmark_min_time=0.2";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, brief.data());
  argc = static_cast<int>(arguments.size());
  argv = arguments.data();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace bench
