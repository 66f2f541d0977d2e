#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/autodiff/fusion.hpp"
#include "avi/autodiff/program.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

/// @file
/// From a graph to a program: in which order, and where results live.

namespace avi {

/// Makes a Program of the nodes that chosen results need. Each operation comes as soon as its operands are
/// known, so that derivatives follow what they are derivatives of. Within a window of lines, operations of
/// one kind are brought together: there are few changes of kind, and results are used soon after they are
/// computed.
class Schedule {
 public:
  /// @param value node of the value, or -1 @param slopes nodes of the derivatives @param recorded nodes
  /// before this one are in the order in which the function wrote them
  static Program program(ExpressionGraph& graph, int value, const std::vector<int>& slopes, int recorded) {
    std::vector<int> results = slopes;
    if (value >= 0) results.push_back(value);
    Schedule schedule(Fusion(graph, results, recorded));
    schedule.group();
    Program program = schedule.assemble(graph, results);
    for (const int slope : slopes)
      program.slopes_.push_back(schedule.place(slope));
    if (value >= 0) program.value_ = schedule.place(value);
    return program;
  }

 private:
  static constexpr int window = 256;

  explicit Schedule(Fusion fusion) : place_(fusion.results(), -1), lines_(std::move(fusion).lines()) {
    std::stable_sort(lines_.begin(), lines_.end(),
                     [](const Line& a, const Line& b) { return a.key < b.key; });
  }

  /// Within each window: all lines that are ready and of the most frequent kind, until none is left.
  void group() {
    std::vector<Line> sorted;
    for (std::size_t first = 0; first < lines_.size(); first += window) {
      const std::size_t last = std::min(first + window, lines_.size());
      std::map<int, std::size_t> writer;  // of a result in this window
      for (std::size_t i = first; i < last; ++i)
        writer[lines_[i].result] = i;
      std::vector<int> missing(last - first, 0);
      std::vector<std::vector<std::size_t>> waiting(last - first);
      std::map<std::pair<Operation, Operation>, std::vector<std::size_t>> all_ready;
      const auto ready = [&](std::size_t i) { all_ready[{lines_[i].first, lines_[i].second}].push_back(i); };
      for (std::size_t i = first; i < last; ++i) {
        for (const int operand : lines_[i].operands)
          if (const auto found = writer.find(operand); found != writer.end()) {
            ++missing[i - first];
            waiting[found->second - first].push_back(i);
          }
        if (missing[i - first] == 0) ready(i);
      }
      for (;;) {
        std::vector<std::size_t>& most = std::ranges::max_element(all_ready, {}, [](const auto& kind) {
                                           return kind.second.size();
                                         })->second;
        if (most.empty()) break;
        // The list may grow during this loop: lines of the same kind that become ready join it.
        for (std::size_t k = 0; k < most.size(); ++k) {
          const std::size_t i = most[k];
          sorted.push_back(lines_[i]);
          for (const std::size_t user : waiting[i - first])
            if (--missing[user - first] == 0) ready(user);
        }
        most.clear();
      }
    }
    lines_ = std::move(sorted);
  }

  Program assemble(const ExpressionGraph& graph, const std::vector<int>& results) {
    Program program;
    program.inputs_ = graph.inputs();
    for (int i = 0; i < graph.inputs(); ++i)
      place_[i] = i;
    const auto needs = [&](int node) {
      if (node >= graph.size() || !graph.is_constant(node) || place_[node] >= 0) return;
      place_[node] = program.inputs_ + static_cast<int>(program.numbers_.size());
      program.numbers_.push_back(graph[node].number);
    };
    // The last line that reads a result; what is asked for is read after all of them.
    std::vector<std::size_t> last(place_.size(), 0);
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (const int operand : lines_[i].operands) {
        needs(operand);
        last[operand] = i;
      }
    for (const int result : results) {
      needs(result);
      last[result] = lines_.size();
    }

    program.slots_ = program.inputs_ + program.numbers_.size();
    std::vector<int> free;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& line = lines_[i];
      Program::Instruction instruction{};
      if (line.first == Operation::sum_of_products) {
        instruction.a = static_cast<Program::Place>(program.products_.size());
        instruction.b = static_cast<Program::Place>(line.operands.size() / 2);
        for (std::size_t k = 0; k < line.operands.size(); k += 2)
          program.products_.push_back({place(line.operands[k]), place(line.operands[k + 1])});
        program.operations_ += line.operands.size() / 2;
      } else {
        const auto operand = [&](std::size_t k) {
          return place(line.operands[std::min(k, line.operands.size() - 1)]);
        };
        instruction = {.to = 0, .a = operand(0), .b = operand(1), .c = operand(2)};
        program.operations_ += line.second == Operation::nothing ? 1 : 2;
      }
      for (const int operand : line.operands)
        if (temporary(graph, operand) && last[operand] == i) {
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
  static bool temporary(const ExpressionGraph& graph, int result) {
    return result >= graph.inputs() && (result >= graph.size() || !graph.is_constant(result));
  }

  std::vector<int> place_;  // of each result
  std::vector<Line> lines_;
};

}  // namespace avi
