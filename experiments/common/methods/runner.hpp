#pragma once
#include "avi/core/integrate.hpp"
#include "avi/core/state.hpp"

#include <functional>
#include <memory>

/// @file
/// A method together with its problem, their types erased.

namespace experiment {

/// The one handle for "a method and its run" of n degrees of freedom: made anew for every start, so that
/// nothing is left over from another run.
template <int n>
class RunnerOf {
 public:
  using State = avi::State<n>;
  /// Called after every step; false stops the run.
  using Observer = std::function<bool(const State&)>;

  /// `make(start)` makes the method for the orbit through `start`.
  template <class H, class Make>
  RunnerOf(const H& hamiltonian, Make make)
      : energy([=](const State& z) { return hamiltonian(z.q, z.p); }), make_([=](const State& start) {
          const auto method = std::make_shared<decltype(make(start))>(make(start));
          return Made{
              [method](State& z, double h, avi::Until until) { return avi::integrate(*method, z, h, until); },
              [method](State& z, double h) { return method->step(z, h); }};
        }) {}

  std::function<double(const State&)> energy;  ///< H.

  /// What a run from `start` is, without its set-up: run(z, h, until). To be timed: the step is known there.
  [[nodiscard]] std::function<avi::Run(State&, double, avi::Until)> prepare(const State& start) const {
    return make_(start).run;
  }

  /// Advances z, a point of the orbit through `start`, with a method made anew.
  [[nodiscard]] avi::Run advance(const State& start, State& z, double h, avi::Until until,
                                 const Observer& observer) const {
    Made made = make_(start);
    return avi::integrate(made, z, h, until, [&](const State& now, long) { return observer(now); });
  }

  /// Same with its state in single precision between steps; the arithmetic within a step stays double.
  [[nodiscard]] RunnerOf in_single_precision() const {
    RunnerOf other = *this;
    other.make_ = [make = make_](const State& start) {
      const auto single = std::make_shared<Made>(make(start));
      single->take_step = [step = single->take_step](State& z, double h) {
        const avi::StepReport report = step(z, h);
        for (int i = 0; i < n; ++i) {
          z.q[i] = in_single(z.q[i]);
          z.p[i] = in_single(z.p[i]);
        }
        return report;
      };
      return Made{
          [single](State& z, double h, avi::Until until) { return avi::integrate(*single, z, h, until); },
          single->take_step};
    };
    return other;
  }

 private:
  /// A method with its type erased.
  struct Made {
    std::function<avi::Run(State&, double, avi::Until)> run;
    std::function<avi::StepReport(State&, double)> take_step;
    avi::StepReport step(State& z, double h) { return take_step(z, h); }
  };

  /// Volatile: GCC 12 drops the pair of conversions where it vectorises them for AVX-512.
  static double in_single(double x) {
    volatile float single = static_cast<float>(x);
    return single;
  }

  std::function<Made(const State& start)> make_;
};

using State2 = avi::State<2>;
using Runner = RunnerOf<2>;

}  // namespace experiment
