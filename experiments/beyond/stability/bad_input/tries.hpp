#pragma once
#include "avi/core/integrate.hpp"
#include "common/table.hpp"

#include <functional>
#include <limits>
#include <map>
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
  /// How many answers of a kind.
  struct Tally {
    long inputs = 0, refused = 0, taken = 0;
  };

  std::string part;                    ///< Of the library, for the rows to come.
  std::map<std::string, Tally> tally;  ///< Of each part.

  /// @param table with the columns part, argument, value, ending, sentence
  explicit Tries(Table& table) : table_(table) {}

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
    std::string ending = "refused", sentence;
    try {
      const avi::Run done = call();
      ending = done.outcome == avi::Outcome::ok ? "taken" : avi::name(done.outcome);
      sentence = done.message;
    } catch (const std::invalid_argument& error) {
      sentence = error.what();
    }
    table_.row(part, argument, written.str(), ending, sentence);
    ++tally[part].inputs;
    tally[part].refused += ending == "refused";
    tally[part].taken += ending == "taken";
  }

  /// Makes call(value) for every value.
  void all(const std::string& argument, const auto& values, const auto& call) {
    for (const auto& value : values)
      one(argument, value, [&] { call(value); });
  }

 private:
  Table& table_;
};

/// The rules of optimisers, and their loop and objectives.
void try_rules(Tries& tries);
void try_update_loop(Tries& tries);

}  // namespace experiment
