#pragma once
#include "avi/core/integrate.hpp"
#include "common/table.hpp"

#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

/// @file
/// Arguments that no entry point can use, and what each answered.

namespace experiment {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr double not_positive[] = {0.0, -0.0, -1.0, nan, inf, -inf};
inline constexpr double not_finite[] = {nan, inf, -inf};

/// Tries arguments and writes down the answers: `refused` with its sentence, the name of the outcome with
/// which a run ended, or `taken`.
class Tries {
 public:
  /// @param table with the columns part, argument, value, ending, sentence
  explicit Tries(experiment::Table& table) : table_(table) {}

  std::string part;  ///< Of the library, for the rows to come.

  /// Makes one call that has to be refused.
  template <class Value>
  void one(const std::string& argument, const Value& value, const std::function<void()>& call) {
    run(argument, value, [&] { return call(), avi::Run{}; });
  }
  /// Makes one run that has to be refused or to end with the name of what was found out on the way.
  template <class Value>
  void run(const std::string& argument, const Value& value, const std::function<avi::Run()>& call) {
    std::ostringstream written;
    written.precision(17);
    written << value;
    try {
      const avi::Run done = call();
      table_.row(part, argument, written.str(),
                 done.outcome == avi::Outcome::ok ? "taken" : avi::name(done.outcome), done.message);
    } catch (const std::invalid_argument& error) {
      table_.row(part, argument, written.str(), "refused", error.what());
    }
  }

  /// Makes call(value) for every value.
  void all(const std::string& argument, const auto& values, const auto& call) {
    for (const auto& value : values)
      one(argument, value, [&] { call(value); });
  }

 private:
  experiment::Table& table_;
};

/// Rules, their loop and objectives.
void try_optimisation(Tries& tries);
/// Integrators, the time loop, monitors and quadrature.
void try_dynamics(Tries& tries);
/// Problems and diagnostics.
void try_problems(Tries& tries);

}  // namespace experiment
