#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

/// FNV-1a (Fowler, Noll and Vo, 1991) of what is added, numbers by their bits: for tests that compare
/// everything with what it was.
class Digest {
 public:
  void add(const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      value_ = (value_ ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3U;
  }
  void add(double x) { add(&x, sizeof x); }
  void add(const std::string& text) { add(text.data(), text.size()); }
  template <class State>
  void add_state(const State& z) {
    add(z.t);
    for (decltype(z.q.size()) i = 0; i < z.q.size(); ++i)
      add(z.q[i]), add(z.p[i]);
  }
  /// Eight digits.
  [[nodiscard]] std::string text() const {
    char digits[9];
    std::snprintf(digits, sizeof digits, "%08x",
                  static_cast<unsigned>((value_ >> 32U) ^ (value_ & 0xffffffffU)));
    return digits;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};
