#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/autodiff/program.hpp"
#include "fusion.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

/// @file
/// From a graph to a program: in which order, and where results live.

namespace avi::detail {

/// Makes a Program of the nodes that chosen results need. Each operation comes as soon as its operands are
/// known, so that derivatives follow what they are derivatives of. Within a window of lines, operations of
/// one kind are brought together: there are few changes of kind, and results are used soon after they are
/// computed.
class Schedule {
 public:
  /// @param value node of the value, or -1 @param slopes nodes of the derivatives @param recorded nodes
  /// before this one are in the order in which the function wrote them
  static Program program(const ExpressionGraph& graph, int value, const std::vector<int>& slopes,
                         int recorded) {
    std::vector<int> results = slopes;
    if (value >= 0) results.push_back(value);
    Schedule schedule(Fusion(graph, results, recorded));
    schedule.group();
    Program program = schedule.assemble(graph.inputs(), results);
    for (const int slope : slopes)
      program.slopes_.push_back(schedule.place(slope));
    if (value >= 0) program.value_ = schedule.place(value);
    return program;
  }

 private:
  static constexpr int window = 256;
  static constexpr int kinds = static_cast<int>(Operation::sum_of_products) + 1;

  explicit Schedule(Fusion fusion) : fusion_(std::move(fusion)), place_(fusion_.results(), -1) { sort(); }

  /// By their keys; those of one key in the order in which they are.
  void sort() {
    int largest = -1;
    for (const Line& line : fusion_.lines())
      largest = std::max(largest, line.key);
    std::vector<int> first(static_cast<std::size_t>(largest) + 3, 0);
    for (const Line& line : fusion_.lines())
      ++first[line.key + 2];
    for (std::size_t key = 1; key < first.size(); ++key)
      first[key] += first[key - 1];
    lines_.resize(fusion_.lines().size());
    for (const Line& line : fusion_.lines())
      lines_[first[line.key + 1]++] = line;
  }

  /// Lines in the order in which they came, each in one list at most.
  struct List {
    int first = -1, last = -1, size = 0;  // positions in the window
    void append(int line, std::vector<int>& next) {
      (first < 0 ? first : next[last]) = line;
      next[last = line] = -1;
      ++size;
    }
  };

  /// Within each window: all lines that are ready and of the most frequent kind, until none is left.
  void group() {
    const auto code = [](const Line& line) {
      return static_cast<short>(static_cast<int>(line.first) * kinds + static_cast<int>(line.second));
    };
    std::vector<short> kind(kinds * kinds, -1), codes;  // kinds are numbered in the order of their codes
    codes.reserve(lines_.size());
    for (const Line& line : lines_)
      if (std::exchange(kind[code(line)], short{0}) < 0) codes.push_back(code(line));
    std::ranges::sort(codes);
    for (std::size_t i = 0; i < codes.size(); ++i)
      kind[codes[i]] = static_cast<short>(i);
    std::vector<List> ready(codes.size());
    std::vector<int> writer(place_.size(), -1);  // of a result in this window
    const std::size_t widest = std::min<std::size_t>(window, lines_.size());
    std::vector<int> missing(widest), next_ready(widest);
    std::vector<List> users(widest);  // of each line, places in `waiting`
    std::vector<int> waiting, next_waiting(fusion_.operand_count());
    waiting.reserve(fusion_.operand_count());
    std::vector<Line> sorted;
    sorted.reserve(lines_.size());
    for (std::size_t first = 0; first < lines_.size(); first += window) {
      const Line* const lines = lines_.data() + first;
      const int size = static_cast<int>(std::min<std::size_t>(window, lines_.size() - first));
      for (int i = 0; i < size; ++i) {
        writer[lines[i].result] = i;
        users[i] = {};
      }
      waiting.clear();
      for (int i = 0; i < size; ++i) {
        missing[i] = 0;
        for (const int operand : fusion_.operands(lines[i]))
          if (const int from = writer[operand]; from >= 0) {
            ++missing[i];
            waiting.push_back(i);
            users[from].append(static_cast<int>(waiting.size()) - 1, next_waiting);
          }
        if (missing[i] == 0) ready[kind[code(lines[i])]].append(i, next_ready);
      }
      for (;;) {
        List& most = *std::ranges::max_element(ready, {}, &List::size);
        if (most.size == 0) break;
        // The list may grow during this loop: lines of the same kind that become ready join it.
        for (int i = most.first; i >= 0; i = next_ready[i]) {
          sorted.push_back(lines[i]);
          for (int use = users[i].first; use >= 0; use = next_waiting[use])
            if (const int user = waiting[use]; --missing[user] == 0)
              ready[kind[code(lines[user])]].append(user, next_ready);
        }
        most = {};
      }
      for (int i = 0; i < size; ++i)
        writer[lines[i].result] = -1;
    }
    lines_.swap(sorted);
  }

  Program assemble(int inputs, const std::vector<int>& results) {
    Program program;
    program.inputs_ = inputs;
    program.instructions_.reserve(lines_.size());
    program.groups_.reserve(lines_.size());
    for (int i = 0; i < inputs; ++i)
      place_[i] = i;
    const auto needs = [&](int node) {
      if (!fusion_.is_constant(node) || place_[node] >= 0) return;
      place_[node] = program.inputs_ + static_cast<int>(program.numbers_.size());
      program.numbers_.push_back(fusion_.number(node));
    };
    // The last line that reads a result; what is asked for is read after all of them.
    std::vector<std::size_t> last(place_.size(), 0);
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (const int operand : fusion_.operands(lines_[i])) {
        needs(operand);
        last[operand] = i;
      }
    for (const int result : results) {
      needs(result);
      last[result] = lines_.size();
    }

    program.slots_ = program.inputs_ + program.numbers_.size();
    std::vector<int> free;
    free.reserve(place_.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& line = lines_[i];
      const std::span<const int> of = fusion_.operands(line);
      Program::Instruction instruction{};
      if (line.first == Operation::sum_of_products) {
        instruction.a = static_cast<Program::Place>(program.products_.size());
        instruction.b = static_cast<Program::Place>(of.size() / 2);
        for (std::size_t k = 0; k < of.size(); k += 2)
          program.products_.push_back({place(of[k]), place(of[k + 1])});
        program.operations_ += of.size() / 2;
      } else {
        const auto operand = [&](std::size_t k) { return place(of[std::min(k, of.size() - 1)]); };
        instruction = {.to = 0, .a = operand(0), .b = operand(1), .c = operand(2)};
        program.operations_ += line.second == Operation::nothing ? 1 : 2;
      }
      for (const int operand : of)
        if (operand >= inputs && !fusion_.is_constant(operand) && last[operand] == i) {
          last[operand] = lines_.size() + 1;  // once, though it may be read twice here
          free.push_back(place_[operand]);
        }
      if (free.empty()) {
        place_[line.result] = static_cast<int>(program.slots_++);
      } else {
        place_[line.result] = free.back();
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
  [[nodiscard]] Program::Place place(int result) const {
    return static_cast<Program::Place>(8 * place_[result]);
  }
  Fusion fusion_;
  std::vector<int> place_;   // of each result
  std::vector<Line> lines_;  // of the fusion, in the order of the program
};

}  // namespace avi::detail
