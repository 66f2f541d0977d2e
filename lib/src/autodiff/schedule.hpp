#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/autodiff/program.hpp"
#include "src/autodiff/fusion.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

/// @file
/// The order in which a program computes the nodes of a graph, and the slots of their results.

namespace avi::detail {

/// The order in which a Program computes the nodes that chosen results need. Each operation comes as soon as
/// its operands are known, so that derivatives follow what they are derivatives of. Within a window of lines,
/// operations of one kind are brought together: the kind changes rarely, and results are used soon after they
/// are computed.
class Schedule {
 public:
  /// Makes a program. @param value node of the value, or -1 @param slopes nodes of the derivatives
  /// @param recorded nodes before this one are in the order in which the function wrote them
  static Program program(const ExpressionGraph& graph, int value, const std::vector<int>& slopes,
                         int recorded) {
    std::vector<int> results;
    results.reserve(slopes.size() + 1);
    results.assign(slopes.begin(), slopes.end());
    if (value >= 0) results.push_back(value);
    Schedule schedule(graph, results, recorded);
    schedule.group();
    Program program = schedule.assemble(graph.inputs(), results);
    program.slopes_.reserve(slopes.size());
    for (const int slope : slopes)
      program.slopes_.push_back(schedule.place(slope));
    if (value >= 0) program.value_ = schedule.place(value);
    return program;
  }

 private:
  static constexpr int window = 256;
  static constexpr int kinds = static_cast<int>(Operation::sum_of_products) + 1;

  Schedule(const ExpressionGraph& graph, const std::vector<int>& results, int recorded)
      : fusion_(graph, results, recorded) {}

  /// The kinds of lines, numbered in the order of their codes.
  class Kinds {
   public:
    explicit Kinds(const std::vector<Line>& lines) {
      numbers_.fill(-1);
      for (const Line& line : lines)
        if (std::exchange(numbers_[code(line)], 0) < 0) codes_[size_++] = code(line);
      std::sort(codes_.begin(), codes_.begin() + size_);
      for (int i = 0; i < size_; ++i)
        numbers_[codes_[i]] = static_cast<signed char>(i);
    }
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] int operator()(const Line& line) const { return numbers_[code(line)]; }

   private:
    static short code(const Line& line) {
      return static_cast<short>(static_cast<int>(line.first) * kinds + static_cast<int>(line.second));
    }
    std::array<signed char, kinds * kinds> numbers_;
    std::array<short, 2 * kinds> codes_;
    int size_ = 0;
  };

  /// A line in the window.
  struct Waiting {
    int kind;
    int missing;  // operands from the window that are not computed yet
    int users;    // the first use of its result, or -1
    int next;     // the next line of its kind that is ready, or -1
  };
  /// A use of a result of the window as an operand.
  struct Use {
    int line, next;  // the next use of the same result, or -1
  };
  /// Lines of one kind that are ready, in the order in which they became so.
  struct Ready {
    int first = -1, last = -1, size = 0;
  };

  /// Sets the order. Within each window, it takes all ready lines of the most frequent kind, until none is
  /// left.
  void group() {
    const std::vector<Line>& lines = fusion_.lines();
    const Kinds kind(lines);
    std::vector<Ready> ready(kind.size());
    std::array<Waiting, window> waiting;
    const auto uses = std::make_unique_for_overwrite<Use[]>(fusion_.operand_count());
    const auto append = [&](int i) {
      Ready& list = ready[waiting[i].kind];
      (list.size++ == 0 ? list.first : waiting[list.last].next) = i;
      waiting[list.last = i].next = -1;
    };
    order_.reserve(lines.size());
    for (std::size_t first = 0; first < lines.size(); first += window) {
      const int begin = static_cast<int>(first),
                size = static_cast<int>(std::min<std::size_t>(window, lines.size() - first));
      for (int i = 0; i < size; ++i)
        waiting[i] = {.kind = kind(lines[begin + i]), .missing = 0, .users = -1, .next = -1};
      int count = 0;
      for (int i = size - 1; i >= 0; --i)  // so that uses are in the order of the lines
        for (const int operand : fusion_.operands(lines[begin + i]))
          if (const int from = fusion_[operand].line - begin; from >= 0) {
            ++waiting[i].missing;
            uses[count] = {.line = i, .next = waiting[from].users};
            waiting[from].users = count++;
          }
      for (int i = 0; i < size; ++i)
        if (waiting[i].missing == 0) append(i);
      for (;;) {
        Ready& most = *std::ranges::max_element(ready, {}, &Ready::size);
        if (most.size == 0) break;
        // The list may grow during this loop: lines of the same kind that become ready join it.
        for (int i = most.first; i >= 0; i = waiting[i].next) {
          order_.push_back(begin + i);
          for (int use = waiting[i].users; use >= 0; use = uses[use].next)
            if (const int user = uses[use].line; --waiting[user].missing == 0) append(user);
        }
        most = {};
      }
    }
  }

  Program assemble(int inputs, const std::vector<int>& results) {
    Program program;
    program.inputs_ = inputs;
    program.instructions_.reserve(order_.size());
    program.groups_.reserve(order_.size());
    for (int i = 0; i < inputs; ++i)
      fusion_[i].slot = i;
    const auto needs = [&](int operand) {
      Operand& it = fusion_[operand];
      if (it.line >= 0 || it.slot >= 0) return;
      it.slot = program.inputs_ + static_cast<int>(program.numbers_.size());
      program.numbers_.push_back(fusion_.number(operand));
    };
    for (const int i : order_)
      for (const int operand : fusion_.operands(fusion_.lines()[i]))
        needs(operand);
    for (const int result : results)
      needs(result);

    program.slots_ = program.inputs_ + program.numbers_.size();
    std::vector<int> free;
    free.reserve(order_.size());
    for (const int i : order_) {
      const Line& line = fusion_.lines()[i];
      const std::span<const int> of = fusion_.operands(line);
      const auto read = [&](std::size_t k) {
        --fusion_[of[k]].uses;
        return place(of[k]);
      };
      Program::Instruction instruction{};
      if (line.first == Operation::sum_of_products) {
        instruction.a = static_cast<Program::Place>(program.products_.size());
        instruction.b = static_cast<Program::Place>(of.size() / 2);
        for (std::size_t k = 0; k < of.size(); k += 2)
          program.products_.push_back({read(k), read(k + 1)});
        program.operations_ += of.size() / 2;
      } else {
        instruction.a = instruction.b = instruction.c = read(0);
        if (of.size() > 1) instruction.b = instruction.c = read(1);
        if (of.size() > 2) instruction.c = read(2);
        program.operations_ += line.second == Operation::nothing ? 1 : 2;
      }
      for (const int operand : of)
        if (Operand& it = fusion_[operand]; it.uses == 0 && it.line >= 0) {
          it.uses = -1;  // free it once, though it may be read twice here
          free.push_back(it.slot);
        }
      Operand& result = fusion_[line.result];
      if (free.empty()) {
        result.slot = static_cast<int>(program.slots_++);
      } else {
        result.slot = free.back();
        free.pop_back();
      }
      instruction.to = place(line.result);
      program.instructions_.push_back(instruction);
      if (program.groups_.empty() || program.groups_.back().first != line.first ||
          program.groups_.back().second != line.second)
        program.groups_.push_back({line.first, line.second, 0});
      ++program.groups_.back().count;
    }
    return program;
  }
  [[nodiscard]] Program::Place place(int result) {
    return static_cast<Program::Place>(8 * fusion_[result].slot);
  }
  Fusion fusion_;
  std::vector<int> order_;  // lines of the fusion in the order of the program
};

}  // namespace avi::detail
