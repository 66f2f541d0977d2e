#pragma once
#include "avi/optim/run_updates.hpp"
#include "common/timing.hpp"
#include "optimisers/optimiser_arena/problems/problem.hpp"

#include <array>
#include <functional>

// The same counting and the same stopping test for every method.

namespace arena {

/// The two tolerances: |g| <= delta |g_0|.
inline constexpr std::array<double, 2> tolerances{1e-6, 1e-10};

/// The work of a method up to where the test first held, or to its end.
struct Passage {
  long iterations = 0;
  long gradients = 0;
  long values = 0;  ///< Calls that asked for the value alone.
  double seconds = 0.0;
  bool converged = false;
};
using Passages = std::array<Passage, tolerances.size()>;  ///< By tolerance.

/// A problem as a method sees it. Every gradient that is asked for is counted and tested, wherever it is
/// taken: a method has converged with the first evaluated gradient that is small enough, at a point no higher
/// than the start.
class Meter {
 public:
  const VectorX x0;     ///< Where to start.
  long iterations = 0;  ///< Kept by the method.
  bool over = false;    ///< The last of the tolerances that are wanted is met, or the cap.
  bool throws = true;   ///< When the run is over; false for C libraries, whose methods look at `over`.

  Meter(const Problem& problem, VectorX start, long cap, std::size_t wanted = tolerances.size())
      : x0(std::move(start)), f_(problem.f), cap_(cap), wanted_(wanted),
        asked_(VectorX::Constant(x0.size(), std::nan(""))), gradient_(x0.size()) {}

  /// Value and gradient.
  double operator()(const VectorX& x, VectorX& gradient) {
    gradient.resize(x.size());
    const bool known = x == asked_;
    if (known) gradient = gradient_;
    const double value = known ? value_ : f_(x, gradient);
    const double size = avi::norm(gradient);
    ++now_.gradients;
    if (now_.gradients == 1) first_ = size, level_ = value;
    for (std::size_t k = 0; k < tolerances.size(); ++k)
      if (!passages_[k].converged && size <= tolerances[k] * first_ &&
          value <= level_ + 1e-8 * std::abs(level_)) {
        passages_[k] = {iterations, now_.gradients, now_.values, elapsed_(), true};
      }
    end_if(passages_[wanted_ - 1].converged);
    return value;
  }
  /// The value alone. Some methods ask for the gradient at the same point next: that is counted, but not
  /// computed twice.
  double value(const VectorX& x) {
    ++now_.values;
    end_if(over);
    if (x != asked_) asked_ = x, value_ = f_(x, gradient_);
    return value_;
  }

  /// Lets the method run, until it returns or throws Over.
  Passages run(const std::function<void(Meter&)>& method) {
    try {
      method(*this);
    } catch (const Over&) {
    }
    now_.iterations = iterations;
    for (Passage& passage : passages_)
      if (!passage.converged) passage = now_;
    return passages_;
  }

 private:
  /// A run is over.
  struct Over {};

  void end_if(bool done) {
    over = done || now_.gradients + now_.values >= cap_;
    if (over && throws) throw Over{};
  }

  const std::function<double(const VectorX&, VectorX&)>& f_;
  long cap_;
  std::size_t wanted_;
  VectorX asked_, gradient_;  ///< Where the value alone was last asked for, and what else is known there.
  double value_ = 0.0;
  double first_ = 0.0, level_ = 0.0;
  Passage now_;
  Passages passages_;
  experiment::Stopwatch elapsed_;
};

/// A meter as the library's optimisers see it: const, as an objective is.
inline auto objective_of(Meter& meter) {
  return [&meter](const VectorX& x, VectorX& g) { return meter(x, g); };
}

/// Updates by a rule of the library until the meter ends them.
void follow(Meter& meter, const auto& rule) {
  (void)avi::run_updates(objective_of(meter), rule, meter.x0, {.delta = 0.0},
                         [&](const avi::Iterate&, long k, long) { meter.iterations = k; });
}

/// A method of the arena.
struct Method {
  std::string name;
  /// Each runs until Over is thrown, Meter::over is set, or it gives up. Of several, learning rates, the
  /// cheapest counts, and each has the cap for itself.
  std::vector<std::function<void(Meter&)>> runs;
  bool slow = false;  ///< Needs thousands of gradients: with the lower cap, and from one start.
};

/// The field: own methods, of first order, conjugate gradients, those of libraries.
std::vector<Method> all_methods();
std::vector<Method> first_order_methods();
std::vector<Method> conjugate_gradients();
std::vector<Method> library_methods();

}  // namespace arena
