#pragma once
#include "optimisers/optimiser_arena/problems/problem.hpp"

#include "avi/optim/run_updates.hpp"

#include <array>
#include <chrono>
#include <functional>

/// @file
/// The same counting and the same stopping test for every method.

namespace arena {

/// The two tolerances: |g| <= delta |g_0|.
inline constexpr std::array<double, 2> tolerances{1e-6, 1e-10};

/// What a method had done when the test first held.
struct Passage {
  long iterations = 0;
  long gradients = 0;
  long values = 0;  ///< Calls that asked for the value alone.
  double seconds = 0.0;
  bool converged = false;
};

/// A run is over: both tests held, or the cap was reached.
struct Over {};

/// A problem as a method sees it. Every gradient that is asked for is counted and tested, wherever it is
/// taken: a method has converged with the first evaluated gradient that is small enough, at a point no higher
/// than the start.
class Meter {
 public:
  /// The run is over at the last of the tolerances that are `wanted`, or at the cap.
  Meter(const Problem& problem, const VectorX& start, long cap, std::size_t wanted = tolerances.size())
      : problem_(problem), x0(start), cap_(cap), wanted_(wanted),
        asked_(VectorX::Constant(start.size(), std::nan(""))), gradient_(start.size()) {}

  /// Value and gradient. Throws Over when the run is over and `throws`.
  double operator()(const VectorX& x, VectorX& gradient) {
    gradient.resize(x.size());
    const bool known = x == asked_;
    if (known) gradient = gradient_;
    const double value = known ? value_ : problem_.f(x, gradient);
    const double size = avi::norm(gradient);
    ++now_.gradients;
    if (now_.gradients == 1) first_ = size, level_ = value;
    for (std::size_t k = 0; k < tolerances.size(); ++k)
      if (!passages[k].converged && size <= tolerances[k] * first_ &&
          value <= level_ + 1e-8 * std::abs(level_)) {
        now_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        now_.iterations = iterations;
        passages[k] = now_;
        passages[k].converged = true;
      }
    over = passages[wanted_ - 1].converged || now_.gradients + now_.values >= cap_;
    if (over && throws) throw Over{};
    return value;
  }
  /// The value alone. Some methods ask for the gradient at the same point next: that is counted, but not
  /// computed twice.
  double value(const VectorX& x) {
    ++now_.values;
    over = over || now_.gradients + now_.values >= cap_;
    if (over && throws) throw Over{};
    if (x != asked_) asked_ = x, value_ = problem_.f(x, gradient_);
    return value_;
  }

  std::array<Passage, tolerances.size()> passages;  ///< By tolerance.
  long iterations = 0;                              ///< Kept by the method.
  bool over = false;
  bool throws = true;  ///< False for methods of C libraries, which look at `over`.
  [[nodiscard]] const Passage& spent() const { return now_; }

 private:
  const Problem& problem_;

 public:
  const VectorX x0;  ///< Where to start.

 private:
  long cap_;
  std::size_t wanted_;
  VectorX asked_, gradient_;  ///< Where the value alone was last asked for, and what else is known there.
  double value_ = 0.0;
  double first_ = 0.0, level_ = 0.0;
  Passage now_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// What the library's optimisers see: a callable that is const, as an objective is.
struct Watched {
  Meter& meter;
  double operator()(const VectorX& x, VectorX& g) const { return meter(x, g); }
};

/// Updates by a rule of the library until the meter ends them.
template <class Rule>
void follow(Meter& meter, const Rule& rule) {
  (void)avi::run_updates(Watched{meter}, rule, meter.x0, {.delta = 0.0},
                         [&](const avi::Iterate&, long k, long) { meter.iterations = k; });
}

/// A method of the arena.
struct Method {
  std::string name;
  std::function<void(Meter&)> run;  ///< Until Over is thrown, Meter::over is set, or it gives up.
  /// Runs of which the cheapest counts: learning rates. Each has the cap for itself.
  std::vector<std::function<void(Meter&)>> choices{};
  bool slow =
      false;  ///< Of the kind that needs thousands of gradients: with the lower cap, and from one start.
};

/// @name The field
/// @{
std::vector<Method> own_methods();
std::vector<Method> first_order_methods();
std::vector<Method> conjugate_gradients();
std::vector<Method> library_methods();
/// @}

}  // namespace arena
