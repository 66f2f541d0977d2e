#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/bregman/bregman_htvi.hpp"
#include "avi/optim/run_updates.hpp"
#include "common/rules/bregman_runge_kutta.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>

// All optimisation methods by name, compiled once for all experiments.

namespace experiment {

/// An objective of any type; the original must outlive it.
class AnyObjective {
 public:
  template <class F>
  AnyObjective(const F& f) : call_(std::cref(f)) {}
  double operator()(const avi::VectorX& x, avi::VectorX& gradient) const { return call_(x, gradient); }
  /// The value alone, which is counted as a value only.
  [[nodiscard]] double value(const avi::VectorX& x) const {
    avi::VectorX unused(x.size());
    return call_(x, unused);
  }

 private:
  std::function<double(const avi::VectorX&, avi::VectorX&)> call_;
};

/// A witness of any type: called with every iterate, its number, and the number of gradients so far;
/// returning false ends the run.
class AnyWitness {
 public:
  AnyWitness() = default;
  /// Stores a reference. A witness that returns nothing never ends the run.
  template <class W>
  requires(!std::is_same_v<std::decay_t<W>, AnyWitness>) AnyWitness(W&& witness)
      : call_([&witness](const avi::Iterate& at, long k, long gradients) {
          if constexpr (std::is_same_v<std::invoke_result_t<W&, const avi::Iterate&, long, long>, bool>)
            return witness(at, k, gradients);
          else
            return witness(at, k, gradients), true;
        }) {}
  bool operator()(const avi::Iterate& at, long k, long gradients) const {
    return !call_ || call_(at, k, gradients);
  }

 private:
  std::function<bool(const avi::Iterate&, long, long)> call_;
};

/// A method and its hyper-parameters; each method uses only those that apply to it.
struct Rule {
  /// Bregman dynamics: htvi, heavy_ball, splitting, clone_strang, clone_y4, clone_y6, runge_kutta_4,
  /// dormand_prince, bogacki_shampine, gsl_rkf45, gsl_rk8pd; others: nag, nag_from_1, adam, adagrad,
  /// rmsprop, trust_region, gradient_descent.
  std::string method;
  avi::BregmanFamily family{};
  double h = std::nan("");               ///< Step or rate; NaN for the default of the method.
  avi::BregmanStart from{};              ///< Start of the Bregman dynamics.
  avi::Clock clock = avi::Clock::euler;  ///< Clock of the method htvi.
  avi::StepControl control{};            ///< Step control of the Runge-Kutta pairs.
};

/// Minimises f from x0 by the method that `rule` names. @throws std::invalid_argument as avi::run_updates(),
/// and for an unknown name.
avi::Minimisation run_updates(const Rule& rule, const AnyObjective& f, const avi::VectorX& x0,
                              const avi::Stopping& stopping = {}, const AnyWitness& witness = {});

}  // namespace experiment
