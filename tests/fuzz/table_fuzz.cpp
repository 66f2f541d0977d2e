#include "fuzz/table.hpp"

/// A libFuzzer target: `make fuzz`.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::table(data, size);
  return 0;
}
