#pragma once
#include "avi/core/integrate.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <sstream>
#include <string>

/// @file
/// Arguments that an entry point cannot use, each refused in one sentence with its value and the admissible
/// range.

namespace tries {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr double not_positive[] = {0.0, -0.0, -1.0, nan, inf, -inf};
inline constexpr double not_finite[] = {nan, inf, -inf};

std::string written(const auto& value) {
  std::ostringstream text;
  text.precision(15);
  text << value;
  return text.str();
}

/// The call refuses this value of an argument.
void one(const std::string& argument, const auto& value, const std::function<void()>& call) {
  const std::string where = argument + " = " + written(value);
  const std::string sentence = refusal(call);
  EXPECT_TRUE(sentence.ends_with(".")) << where << ": " << sentence;
  EXPECT_NE(sentence.find(" is " + written(value) + "; it must be "), std::string::npos)
      << where << ": " << sentence;
}
/// call(value) refuses each of these values.
void all(const std::string& argument, const auto& values, const auto& call) {
  for (const auto& value : values)
    one(argument, value, [&] { call(value); });
}

/// What no argument shows ends the run, with a name.
void run(const std::string& argument, const auto& value, const std::function<avi::Run()>& call) {
  const avi::Run run = call();
  const std::string where = argument + " = " + written(value) + ": " + run.message;
  EXPECT_TRUE(run.outcome == avi::Outcome::non_finite || run.outcome == avi::Outcome::bad_monitor ||
              run.outcome == avi::Outcome::not_converged)
      << where;
  EXPECT_TRUE(run.message.ends_with(".")) << where;
  EXPECT_NE(run.message.find(avi::name(run.outcome)), std::string::npos) << where;
}

}  // namespace tries
