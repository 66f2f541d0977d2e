#pragma once
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

/// The sentence by which a call refuses its arguments, or "accepted".
std::string refusal(const auto& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// A part of that sentence.
void expect_refusal(const auto& call, const std::string& part) {
  const std::string sentence = refusal(call);
  EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}
