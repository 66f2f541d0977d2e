#include "fuzz/step.hpp"

/// A libFuzzer target: `make fuzz`.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::step(data, size);
  return 0;
}
