#pragma once
#include <cstdint>
#include <cstring>
#include <vector>

/// @file
/// The few instructions of an x86-64 processor that formulas are made of, as bytes.

namespace avi::detail {

/// An assembler for instructions on whole vector registers. Encodings: Intel 64 and IA-32 Architectures
/// Software Developer's Manual, volume 2, sections 2.3 (VEX) and 2.7 (EVEX).
class Assembler {
 public:
  /// The numbers of general registers.
  enum Pointer { rax = 0, rcx = 1, rdx = 2, rbx = 3, rsp = 4, rbp = 5, rsi = 6, rdi = 7, r8 = 8 };
  /// A vector register, or memory at a pointer.
  struct Place {
    int vector = -1;      ///< Number of the register, or -1.
    int pointer = rsp;    ///< Pointer, where there is no register.
    std::int32_t at = 0;  ///< Number of bytes from the pointer.
  };
  /// The opcodes of instructions with prefix 66 in the map 0F.
  enum Instruction : std::uint8_t {
    load = 0x10,
    store = 0x11,
    square_root = 0x51,
    bits_and = 0x54,
    bits_or = 0x56,
    add = 0x58,
    multiply = 0x59,
    subtract = 0x5c,
    divide = 0x5e,
    compare = 0xc2
  };
  enum Comparison : std::uint8_t { less = 1, less_equal = 2, differs = 4 };  ///< Condition of `compare`.

  /// Begins code for registers of 2, 4 or 8 numbers.
  explicit Assembler(int numbers) : bytes_(8 * numbers) {}

  std::vector<std::uint8_t> code;  ///< The bytes so far.

  [[nodiscard]] int bytes() const { return bytes_; }  ///< Size of a register in bytes.

  /// Writes to = first `what` second. @param mask number of a mask register with the lanes that are computed,
  /// the others become 0; or 0 for all lanes
  void vector(Instruction what, int to, int first, const Place& second, int mask = 0) {
    if (bytes_ == 64 || mask != 0 || to > 15 || first > 15 || second.vector > 15)
      long_form(what, to, first, second, mask);
    else
      short_form(what, to, first, second);
  }
  /// Writes the comparison of two registers of at most 4 numbers. Each lane of `to` gets all bits where it
  /// holds, or none.
  void compare_lanes(Comparison how, int to, int first, const Place& second) {
    short_form(compare, to, first, second);
    code.push_back(how);
  }
  /// Writes the same comparison, into the bits of the mask register k1.
  void compare_to_mask(Comparison how, int first, const Place& second) {
    long_form(compare, 1, first, second, 0);
    code.push_back(how);
  }

  /// Writes bytes as they are.
  void raw(std::initializer_list<int> all) {
    for (const int byte : all)
      code.push_back(static_cast<std::uint8_t>(byte));
  }
  /// Writes pointer = number.
  void set(int pointer, std::uint64_t number) {
    raw({0x48 | pointer >> 3, 0xb8 | (pointer & 7)});
    append(number);
  }
  /// Writes pointer = other + bytes.
  void address(int pointer, int other, std::int32_t bytes) {
    raw({0x48 | (pointer >> 3) << 2 | other >> 3, 0x8d});
    memory(pointer, {.pointer = other, .at = bytes}, 1);
  }
  /// Writes the bytes of a number.
  template <class Number>
  void append(Number number) {
    const std::size_t end = code.size();
    code.resize(end + sizeof(number));
    std::memcpy(code.data() + end, &number, sizeof(number));
  }

 private:
  static int bit(int number, int k) { return ~number >> k & 1; }  // inverted, as prefixes have them
  void operand(int to, const Place& place, int unit) {
    if (place.vector >= 0)
      raw({0xc0 | (to & 7) << 3 | (place.vector & 7)});
    else
      memory(to, place, unit);
  }
  /// Writes an address whose distance takes one byte, in multiples of `unit`, or four bytes.
  void memory(int to, const Place& place, int unit) {
    const bool is_short = place.at % unit == 0 && place.at / unit >= -128 && place.at / unit < 128;
    raw({(is_short ? 0x40 : 0x80) | (to & 7) << 3 | (place.pointer & 7)});
    if ((place.pointer & 7) == rsp) raw({0x24});
    if (is_short)
      raw({place.at / unit & 0xff});
    else
      append(place.at);
  }
  void short_form(Instruction what, int to, int first, const Place& second) {
    const int base = second.vector >= 0 ? second.vector : second.pointer;
    raw({0xc4, bit(to, 3) << 7 | 1 << 6 | bit(base, 3) << 5 | 1, (~first & 15) << 3 | (bytes_ == 32) << 2 | 1,
         what});
    operand(to, second, 1);
  }
  void long_form(Instruction what, int to, int first, const Place& second, int mask) {
    const bool in_register = second.vector >= 0;
    const int base = in_register ? second.vector : second.pointer;
    raw({0x62,
         bit(to, 3) << 7 | (in_register ? bit(base, 4) : 1) << 6 | bit(base, 3) << 5 | bit(to, 4) << 4 | 1,
         1 << 7 | (~first & 15) << 3 | 1 << 2 | 1,
         (mask != 0) << 7 | bytes_ / 32 << 5 | bit(first, 4) << 3 | mask, what});
    operand(to, second, bytes_);
  }

  int bytes_;
};

}  // namespace avi::detail
