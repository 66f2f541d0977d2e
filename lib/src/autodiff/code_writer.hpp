#pragma once
#include "src/autodiff/assembler.hpp"
#include "src/autodiff/machine_code.hpp"
#include "src/autodiff/straight_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

/// @file
/// The instructions for a straight line of operations, with registers chosen for values.

namespace avi::detail {

/// The writer of the code of one program. If no register is free, the one whose value is needed last is given
/// up (Belady 1966).
class CodeWriter {
 public:
  /// The numbers at the beginning of every pool.
  enum Pooled : std::size_t { one, zero, sign_bit, magnitude };

  CodeWriter(const StraightLine& line, const MachineTarget& target, std::vector<double>& pool, Assembler& out)
      : line_(line), target_(target), pool_(pool), out_(out), parts_(8 * target.lanes / out.bytes()),
        holds_(target.avx512 ? 32 : 16, -1), pinned_(holds_.size(), 0), first_number_(pool.size()) {
    pool_.insert(pool_.end(), line.numbers.begin(), line.numbers.end());
    calls_ = std::ranges::any_of(line.lines, [&](const auto& each) { return is_call(each); });
  }

  /// Writes the code. @return the place in the code for the address of the pool
  std::size_t write() {
    const std::size_t address_at = begin();
    // The parts of a pack are computed one after the other or, where functions of whole packs are called,
    // side by side.
    if (calls_) {
      compute(0, parts_);
    } else {
      for (int part = 0; part < parts_; ++part)
        compute(part, part + 1);
    }
    end();
    return address_at;
  }

  /// Number of bytes of the stack that the code takes.
  [[nodiscard]] std::size_t frame() const {
    return static_cast<std::size_t>(scratch) +
           static_cast<std::size_t>(slots_) * static_cast<std::size_t>(out_.bytes());
  }

 private:
  using Place = Assembler::Place;
  static constexpr int never = std::numeric_limits<int>::max();
  struct Value {
    int in = -1;       // register
    int spilled = -1;  // slot of the frame
    int next = never;  // line of its next use
  };

  static bool is_call(const StraightLine::Line& it) {
    using enum Operation;
    switch (it.first) {
    case add:
    case subtract:
    case subtract_from:
    case multiply:
    case divide:
    case sqrt:
    case abs:
    case sign:
    case less:
    case less_equal:
    case when:
    case nothing:
      return false;
    default:
      return true;
    }
  }

  static constexpr int scratch = 128;  // two packs for calls, at the bottom of the frame

  std::size_t begin() {
    out_.raw({0xf3, 0x0f, 0x1e, 0xfa, 0x55, 0x48, 0x89, 0xe5});  // endbr64; push rbp; mov rbp, rsp
    if (calls_) {
      // push rbx, r12, r13, r14, r15; mov rbx, rdi; mov r13, rsi; mov r14, rdx; mov r15, rcx
      out_.raw({0x53, 0x41, 0x54, 0x41, 0x55, 0x41, 0x56, 0x41, 0x57, 0x48, 0x89,
                0xfb, 0x49, 0x89, 0xf5, 0x49, 0x89, 0xd6, 0x49, 0x89, 0xcf});
      q_ = 3, p_ = 13, factor_ = 14, result_ = 15, numbers_ = 12;
    }
    out_.set(numbers_, 0);
    const std::size_t address_at = out_.code.size() - 8;
    out_.raw({0x48, 0x81, 0xec});  // sub rsp, ...
    frame_size_at_ = out_.code.size();
    out_.append(std::int32_t{0});
    out_.raw({0x48, 0x83, 0xe4, 0xc0});  // and rsp, -64
    return address_at;
  }
  void end() {
    out_.raw({0xc5, 0xf8, 0x77});  // vzeroupper
    const auto size = static_cast<std::int32_t>(frame());
    std::memcpy(out_.code.data() + frame_size_at_, &size, sizeof(size));
    if (calls_) {
      out_.address(Assembler::rsp, Assembler::rbp, -40);
      out_.raw({0x41, 0x5f, 0x41, 0x5e, 0x41, 0x5d, 0x41, 0x5c, 0x5b, 0x5d});  // pop r15 ... r12, rbx, rbp
    } else {
      out_.raw({0xc9});  // leave
    }
    out_.raw({0xc3});  // ret
  }
  [[nodiscard]] Place frame(int slot) const {
    return {.pointer = Assembler::rsp, .at = scratch + slot * out_.bytes()};
  }
  /// Place of number i of the pool.
  [[nodiscard]] Place pooled(std::size_t i) const {
    return {.pointer = numbers_, .at = static_cast<std::int32_t>(static_cast<std::size_t>(out_.bytes()) * i)};
  }

  Value& value(int v, int part) {
    return values_[static_cast<std::size_t>(v * parts_now_ + part - first_part_)];
  }
  /// Place where a value that is in no register can be read.
  Place memory(int v, int part) {
    if (v < line_.inputs) {
      const int half = (line_.inputs - target_.parameters) / 2, i = v < half ? v : v - half;
      if (i >= half)
        return {.pointer = factor_, .at = 8 * target_.lanes * (1 + i - half) + out_.bytes() * part};
      return {.pointer = v < half ? q_ : p_, .at = 8 * target_.lanes * i + out_.bytes() * part};
    }
    if (v < line_.first_result()) return pooled(first_number_ + static_cast<std::size_t>(v - line_.inputs));
    return frame(value(v, part).spilled);
  }
  void release(int in) { holds_[in] = -1; }
  /// Returns a free register, giving up the value of one if need be.
  int take() {
    int best = -1, furthest = -1;
    for (int i = 0; i < static_cast<int>(holds_.size()); ++i) {
      if (pinned_[i]) continue;
      if (holds_[i] < 0) return best = i, pinned_[i] = 1, i;
      const int next = values_[holds_[i]].next;
      if (next > furthest) furthest = next, best = i;
    }
    drop(best);
    pinned_[best] = 1;
    return best;
  }
  /// Frees a register. Its value goes to memory if it is still needed and not there yet.
  void drop(int in) {
    Value& it = values_[holds_[in]];
    const int v = holds_[in] / parts_now_;
    if (v >= line_.first_result() && it.spilled < 0 && it.next != never) {
      if (free_slots_.empty()) free_slots_.push_back(slots_++);
      it.spilled = free_slots_.back();
      free_slots_.pop_back();
      out_.vector(Assembler::store, in, 0, frame(it.spilled));
    }
    it.in = -1;
    release(in);
  }
  [[nodiscard]] bool has_free() const {
    for (std::size_t i = 0; i < holds_.size(); ++i)
      if (holds_[i] < 0 && !pinned_[i]) return true;
    return false;
  }
  int in_register(int v, int part) {
    Value& it = value(v, part);
    if (it.in < 0) {
      const int in = take();
      out_.vector(Assembler::load, in, 0, memory(v, part));
      hold(in, v, part);
    }
    pinned_[it.in] = 1;
    return it.in;
  }
  Place anywhere(int v, int part) {
    Value& it = value(v, part);
    if (it.in < 0 && (it.next == never || v < line_.first_result() || !has_free())) return memory(v, part);
    return {.vector = in_register(v, part)};
  }
  void hold(int in, int v, int part) {
    value(v, part).in = in;
    holds_[in] = v * parts_now_ + part - first_part_;
  }
  /// Frees register and slot of a value after its last use.
  void forget_if_dead(int v, int part) {
    Value& it = value(v, part);
    if (it.next != never) return;
    if (it.in >= 0) {
      pinned_[it.in] = 0;
      release(std::exchange(it.in, -1));
    }
    if (it.spilled >= 0) free_slots_.push_back(std::exchange(it.spilled, -1));
  }

  void compute(int first_part, int end_part) {
    first_part_ = first_part;
    parts_now_ = end_part - first_part;
    values_.assign(static_cast<std::size_t>(line_.values() * parts_now_), {});
    std::ranges::fill(holds_, -1);
    free_slots_.clear();
    for (int i = 0; i < slots_; ++i)
      free_slots_.push_back(i);
    find_uses();
    for (int k = 0; k < static_cast<int>(line_.order.size()); ++k) {
      const int i = line_.order[k];
      const StraightLine::Line& it = line_.lines[i];
      const bool call = is_call(it);
      for (int part = first_part; part < end_part; ++part) {
        for (int j = 0; j < 3; ++j)
          if (const int v = operand(it, j); v >= 0) value(v, part).next = next_use_[k][j];
        value(line_.first_result() + i, part).next = next_of_result_[i];
      }
      if (call) {
        call_function(it, line_.first_result() + i, first_part, end_part);
      } else {
        for (int part = first_part; part < end_part; ++part) {
          pin_operands(it, part, end_part);
          compute(it, line_.first_result() + i, part);
          for (int j = 0; j < 3; ++j)
            if (const int v = operand(it, j); v >= 0) forget_if_dead(v, part);
        }
      }
    }
  }
  /// Keeps the operands of a line in their registers until they have been read.
  void pin_operands(const StraightLine::Line& it, int first_part, int end_part) {
    std::ranges::fill(pinned_, 0);
    for (int part = first_part; part < end_part; ++part)
      for (int j = 0; j < 3; ++j)
        if (const int v = operand(it, j); v >= 0 && value(v, part).in >= 0) pinned_[value(v, part).in] = 1;
  }
  static int operand(const StraightLine::Line& it, int j) { return j == 0 ? it.a : j == 1 ? it.b : it.c; }
  /// Finds, for each operand of each line, the next line that reads it.
  void find_uses() {
    if (!next_use_.empty()) return;
    next_use_.resize(line_.order.size());
    next_of_result_.resize(line_.lines.size());
    std::vector<int> seen(line_.values(), never);
    for (int k = static_cast<int>(line_.order.size()); k-- > 0;) {
      const StraightLine::Line& it = line_.lines[line_.order[k]];
      next_of_result_[line_.order[k]] = seen[line_.first_result() + line_.order[k]];
      for (int j = 0; j < 3; ++j)
        if (const int v = operand(it, j); v >= 0) next_use_[k][j] = seen[v];
      for (int j = 0; j < 3; ++j)
        if (const int v = operand(it, j); v >= 0) seen[v] = k;
    }
  }
  void compute(const StraightLine::Line& it, int result, int part) {
    using enum Operation;
    if (it.out >= 0) {
      const Place to{.pointer = result_, .at = 8 * target_.lanes * it.out + out_.bytes() * part};
      const int x = in_register(it.a, part);
      int y = x;
      if (line_.scaled) {
        y = take();
        out_.vector(Assembler::multiply, y, x,
                    {.pointer = factor_, .at = static_cast<std::int32_t>(out_.bytes() * part)});
      }
      out_.vector(Assembler::store, y, 0, to);
      return;
    }
    const int to = simple(it, part);
    if (it.second != nothing) {
      const Place c =
          it.second == subtract_from ? Place{.vector = in_register(it.c, part)} : anywhere(it.c, part);
      if (it.second == subtract_from)
        out_.vector(Assembler::subtract, to, c.vector, {.vector = to});
      else
        out_.vector(instruction(it.second), to, to, c);
    }
    hold(to, result, part);
    if (value(result, part).next == never) value(result, part).in = -1, release(to);
  }
  static Assembler::Instruction instruction(Operation operation) {
    switch (operation) {
    case Operation::add:
      return Assembler::add;
    case Operation::subtract:
      return Assembler::subtract;
    case Operation::multiply:
      return Assembler::multiply;
    default:
      return Assembler::divide;
    }
  }
  /// Writes the first operation of a line. @return a register of its own
  int simple(const StraightLine::Line& it, int part) {
    using enum Operation;
    switch (it.first) {
    case add:
    case multiply: {
      Place a = anywhere(it.a, part), b = anywhere(it.b, part);
      if (a.vector < 0 && b.vector < 0) a = {.vector = in_register(it.a, part)};
      if (a.vector < 0) std::swap(a, b);
      const int to = take();
      out_.vector(instruction(it.first), to, a.vector, b);
      return to;
    }
    case subtract:
    case divide: {
      const int a = in_register(it.a, part);
      const Place b = anywhere(it.b, part);
      const int to = take();
      out_.vector(instruction(it.first), to, a, b);
      return to;
    }
    case sqrt: {
      const Place a = anywhere(it.a, part);
      const int to = take();
      out_.vector(Assembler::square_root, to, 0, a);
      return to;
    }
    case abs:
    case sign: {
      const int a = in_register(it.a, part), to = take();
      if (it.first == abs) {
        out_.vector(Assembler::bits_and, to, a, pooled(magnitude));
      } else {
        // 1 with the sign of a, but 0 where a is zero
        const int signed_one = take();
        out_.vector(Assembler::bits_and, signed_one, a, pooled(sign_bit));
        out_.vector(Assembler::bits_or, signed_one, signed_one, pooled(one));
        if (target_.avx512) {
          out_.compare_to_mask(Assembler::differs, a, pooled(zero));
          out_.vector(Assembler::load, to, 0, {.vector = signed_one}, 1);
        } else {
          out_.compare_lanes(Assembler::differs, to, a, pooled(zero));
          out_.vector(Assembler::bits_and, to, to, {.vector = signed_one});
        }
      }
      return to;
    }
    case less:
    case less_equal:
    case when: {
      // The result is 1 where a < b or a <= b, or b where 0 < a; elsewhere it is 0.
      const bool choose = it.first == when;
      const int a = in_register(it.a, part), b = in_register(it.b, part), to = take();
      const auto how = it.first == less_equal ? Assembler::less_equal : Assembler::less;
      const int x = choose ? take() : a, y = choose ? a : b;
      if (choose) out_.vector(Assembler::load, x, 0, pooled(zero));
      const Place chosen = choose ? Place{.vector = b} : pooled(one);
      if (target_.avx512) {
        out_.compare_to_mask(how, x, {.vector = y});
        out_.vector(Assembler::load, to, 0, chosen, 1);
      } else {
        out_.compare_lanes(how, to, x, {.vector = y});
        out_.vector(Assembler::bits_and, to, to, chosen);
      }
      return to;
    }
    default:
      computes_nothing(it.first);
    }
  }
  /// Writes the call of any other operation, on a whole pack in memory.
  void call_function(const StraightLine::Line& it, int result, int first_part, int end_part) {
    pin_operands(it, first_part, end_part);
    for (int part = first_part; part < end_part; ++part)
      for (int j = 0; j < 2; ++j)
        if (const int v = operand(it, j); v >= 0) {
          const int x = in_register(v, part);
          out_.vector(Assembler::store, x, 0,
                      {.pointer = Assembler::rsp, .at = 64 * j + out_.bytes() * part});
          pinned_[x] = 0;
        }
    for (int i = 0; i < static_cast<int>(holds_.size()); ++i)
      if (holds_[i] >= 0) drop(i);
    for (int part = first_part; part < end_part; ++part)
      for (int j = 0; j < 2; ++j)
        if (const int v = operand(it, j); v >= 0) forget_if_dead(v, part);
    out_.address(Assembler::rdi, Assembler::rsp, 0);
    out_.address(Assembler::rsi, Assembler::rsp, 64);
    out_.set(Assembler::rax, reinterpret_cast<std::uint64_t>(target_.functions[static_cast<int>(it.first)]));
    // Functions of the standard library may have instructions that are many times slower while the upper
    // parts of registers are in use.
    out_.raw({0xc5, 0xf8, 0x77});  // vzeroupper
    out_.raw({0xff, 0xd0});        // call rax
    for (int part = first_part; part < end_part; ++part) {
      const int to = take();
      out_.vector(Assembler::load, to, 0, {.pointer = Assembler::rsp, .at = out_.bytes() * part});
      pinned_[to] = 0;
      if (value(result, part).next != never) hold(to, result, part);
    }
  }

  const StraightLine& line_;
  const MachineTarget target_;
  std::vector<double>& pool_;
  Assembler& out_;
  int parts_;                           // number of registers of a pack
  int first_part_ = 0, parts_now_ = 1;  // those that are computed side by side
  bool calls_ = false;
  int q_ = Assembler::rdi, p_ = Assembler::rsi, factor_ = Assembler::rdx, result_ = Assembler::rcx,
      numbers_ = Assembler::rax;
  std::size_t frame_size_at_ = 0;
  std::vector<int> holds_;    // the value in each register
  std::vector<char> pinned_;  // registers of the current line
  std::vector<Value> values_;
  std::size_t first_number_;  // first number of this program in the pool
  std::vector<std::array<int, 3>> next_use_;
  std::vector<int> next_of_result_;
  std::vector<int> free_slots_;
  int slots_ = 0;
};

}  // namespace avi::detail
