#pragma once
#include "avi/core/outcome.hpp"
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

/// Tries arguments and writes down the answers: `refused` with its sentence, or `taken`.
class Tries {
 public:
  /// @param table with the columns part, argument, value, ending, sentence
  explicit Tries(experiment::Table& table) : table_(table) {}

  std::string part;  ///< Of the library, for the rows to come.

  /// Makes one call that has to be refused.
  template <class Value>
  void one(const std::string& argument, const Value& value, const std::function<void()>& call) {
    std::ostringstream written;
    written.precision(17);
    written << value;
    try {
      call();
      table_.row(part, argument, written.str(), "taken", "");
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
