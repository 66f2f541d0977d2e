#pragma once
#include <gtest/gtest.h>

/// The answer of solve(), which has to be kept; else its report is shown, for the line of the call.
template <class Orbit>
Orbit kept(Orbit orbit, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (!orbit.kept()) ADD_FAILURE_AT(file, line) << orbit.report();
  return orbit;
}
