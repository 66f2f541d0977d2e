#include "beyond/speed/bench/run.hpp"

#include "avi/integrators/adaptive_verlet.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/composition.hpp"
#include "avi/integrators/embedded_runge_kutta.hpp"
#include "avi/integrators/hairer_soderlind.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/tableaus.hpp"

#include <string>

// Every explicit method.

namespace {

using avi::Kepler;
using Verlet = decltype(avi::stormer_verlet<2>(&Kepler::potential_gradient<double>));

Verlet verlet() { return avi::stormer_verlet<2>(&Kepler::potential_gradient<double>); }

/// Coefficients with the exact flows of T and V, and with those of the logarithmic Hamiltonian.
void both(const std::string& name, const avi::SplitCoefficients& c, double h, double h_log) {
  bench::add(
      name, [=] { return avi::splitting(avi::Separable<Kepler>{}, c); }, h);
  bench::add(
      "log_hamiltonian_" + name,
      [=] { return avi::splitting(avi::LogHamiltonian<Kepler>(Kepler{}, bench::start()), c); }, h_log);
}
void both(const std::string& name, const avi::CompositionCoefficients& c, double h, double h_log) {
  both(name, avi::split(c), h, h_log);
}

/// A Runge-Kutta step of fixed size.
template <class T>
class RungeKutta {
 public:
  avi::StepReport step(avi::State<2>& z, double h) {
    avi::VectorX joined(4);
    joined << z.q, z.p;
    field(joined, stages_.k[0]);
    stages_.advance(&field, joined, h);
    z.q = stages_.end.template head<2>();
    z.p = stages_.end.template tail<2>();
    z.t += h;
    return {.evaluations = T::stages};
  }

 private:
  static void field(const avi::VectorX& z, avi::VectorX& dz) {
    const avi::Vector<double, 2> q = z.head<2>();
    dz.head<2>() = z.tail<2>();
    dz.tail<2>() = -Kepler::potential_gradient(q);
  }
  avi::RungeKuttaStages<T> stages_{4};
};

/// A Runge-Kutta pair that chooses its steps by its error.
template <class T>
void controlled(benchmark::State& state, double tolerance) {
  const avi::StepControl control{.rtol = tolerance, .atol = tolerance};
  const auto field = [](const avi::VectorX& z, avi::VectorX& dz) {
    const avi::Vector<double, 2> q = z.head<2>();
    dz.head<2>() = z.tail<2>();
    dz.tail<2>() = -Kepler::potential_gradient(q);
  };
  long steps = 0;
  std::clock_t ticks = 0;
  for (auto _ : state) {
    avi::RungeKuttaStages<T> stages(4);
    const auto z0 = bench::start();
    avi::VectorX z(4);
    z << z0.q, z0.p;
    const std::clock_t begin = std::clock();
    double h = 1e-3, t = 0.0;
    for (; t < bench::horizon; ++steps) {
      field(z, stages.k[0]);
      const double taken = avi::controlled_step(stages, field, z, h, control);
      if (!(taken > 0.0)) {
        state.SkipWithError("no step is small enough");
        break;
      }
      t += taken;
      z = stages.end;
    }
    ticks += std::clock() - begin;
    benchmark::DoNotOptimize(z);
  }
  const double each = static_cast<double>(ticks) / CLOCKS_PER_SEC / static_cast<double>(steps);
  state.counters["ns_per_step"] = 1e9 * each;
  state.counters["in_verlet_steps"] = each / bench::verlet_seconds;
}

template <class T>
void runge_kutta(double h) {
  const std::string name(T::name);
  bench::add(
      name, [] { return RungeKutta<T>(); }, h);
  if constexpr (avi::EmbeddedTableau<T>)
    benchmark::RegisterBenchmark((name + "_controlled").c_str(),
                                 [](benchmark::State& state) { controlled<T>(state, 1e-8); });
}

void register_all() {
  namespace c = avi::compositions;
  namespace s = avi::splittings;
  both("strang", c::strang, 1e-3, 0.01);
  both("yoshida4", c::yoshida4, 3e-3, 0.05);
  both("suzuki4", c::suzuki4, 5e-3, 0.05);
  both("yoshida6", c::yoshida6, 5e-3, 0.05);
  both("kahan_li6", c::kahan_li6, 5e-3, 0.05);
  both("kahan_li8", c::kahan_li8, 5e-3, 0.1);
  both("sofroniou_spaletta10", c::sofroniou_spaletta10, 1e-2, 0.1);
  both("blanes_moan4", s::blanes_moan4, 5e-3, 0.05);
  both("blanes_moan6", s::blanes_moan6, 5e-3, 0.05);
  bench::add(
      "composition_kahan_li8", [] { return avi::Composition<Verlet>(verlet(), c::kahan_li8); }, 5e-3);
  bench::add(
      "blanes_moan6_nystrom",
      [] { return avi::splitting(avi::Separable<Kepler>{}, s::blanes_moan6_nystrom); }, 1e-2);
  using Follow = avi::PowerOfRadius;
  bench::add(
      "adaptive_verlet", [] { return avi::AdaptiveVerlet<Kepler, Follow>(Kepler{}, Follow{}); }, 0.01);
  bench::add(
      "hairer_soderlind", [] { return avi::HairerSoderlind<Verlet, Follow>(verlet(), Follow{}); }, 0.01);
  runge_kutta<avi::ExplicitEuler>(1e-4);
  runge_kutta<avi::ClassicalRungeKutta>(1e-3);
  runge_kutta<avi::BogackiShampine>(1e-3);
  runge_kutta<avi::DormandPrince>(1e-3);
}

}  // namespace

int main(int argc, char** argv) { return bench::main(argc, argv, &register_all); }
