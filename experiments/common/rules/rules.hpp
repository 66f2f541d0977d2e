#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/bregman/bregman_htvi.hpp"
#include "avi/optim/run_updates.hpp"
#include "common/rules/bregman_runge_kutta.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>

// Every optimisation method by its name, compiled once for all experiments.

namespace experiment {

/// An objective with its type erased; the objective must outlive it.
class AnyObjective {
 public:
  template <class F>
  AnyObjective(const F& f) : call_(std::cref(f)) {}
  double operator()(const avi::VectorX& x, avi::VectorX& gradient) const { return call_(x, gradient); }
  /// The value alone, and counted as that.
  [[nodiscard]] double value(const avi::VectorX& x) const {
    avi::VectorX unused(x.size());
    return call_(x, unused);
  }

 private:
  std::function<double(const avi::VectorX&, avi::VectorX&)> call_;
};

/// Sees every iterate, its number and the gradients so far; false ends the run.
class AnyWitness {
 public:
  AnyWitness() = default;
  /// Keeps a reference. What returns nothing never ends a run.
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

/// A method and its hyper-parameters; each method uses those that it has.
struct Rule {
  /// Bregman dynamics: htvi, heavy_ball, splitting, clone_strang, clone_y4, clone_y6, runge_kutta_4,
  /// dormand_prince, bogacki_shampine, gsl_rkf45, gsl_rk8pd; others: nag, nag_from_1, adam, adagrad,
  /// rmsprop, trust_region, gradient_descent.
  std::string method;
  avi::BregmanFamily family{};
  double h = std::nan("");               ///< Step or rate; NaN: what the method has as its default.
  avi::BregmanStart from{};              ///< Start of Bregman dynamics.
  avi::Clock clock = avi::Clock::euler;  ///< Clock of htvi.
  avi::StepControl control{};            ///< Step control of Runge-Kutta pairs.
};

/// Minimises f from x0. @throws std::invalid_argument as avi::run_updates(), and where Rule names no such
/// method.
avi::Minimisation run_updates(const Rule& rule, const AnyObjective& f, const avi::VectorX& x0,
                              const avi::Stopping& stopping = {}, const AnyWitness& witness = {});

}  // namespace experiment
