#pragma once
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
