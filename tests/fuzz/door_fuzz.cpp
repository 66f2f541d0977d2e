#include "fuzz/door.hpp"

/// A libFuzzer target: `make fuzz`.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::door(data, size);
  return 0;
}
