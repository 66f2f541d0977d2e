#pragma once
#include "avi/autodiff/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

/// @file
/// A program as a straight line of operations on values, instead of slots.

namespace avi::detail {

/// A program with a result for each operation, in an order in which results are used soon after they are
/// computed.
class StraightLine {
 public:
  /// The operation (a first b) second c, or output number `out` of a.
  struct Line {
    Operation first, second;
    int a, b = -1, c = -1;  // values: arguments, then numbers, then the results of lines
    int out = -1;
  };

  explicit StraightLine(const Program& program)
      : inputs(program.inputs_), numbers(program.numbers_), scaled(!program.slopes_.empty()) {
    one_ = first_result();
    numbers.push_back(1.0);
    read(program);
    sort();
  }

  int inputs;
  std::vector<double> numbers;
  bool scaled;  // outputs are multiplied by the factor
  std::vector<Line> lines;
  std::vector<int> order;

  [[nodiscard]] int first_result() const { return inputs + static_cast<int>(numbers.size()); }
  [[nodiscard]] int values() const { return first_result() + static_cast<int>(lines.size()); }
  [[nodiscard]] bool is_number(int value, double number) const {
    return value >= inputs && value < first_result() && numbers[value - inputs] == number;
  }

 private:
  /// Reads a program: slots are replaced by the values in them, and sums of products are added one by one.
  void read(const Program& program) {
    std::vector<int> held(program.slots_, -1);
    for (int i = 0; i < one_; ++i)
      held[i] = i;
    const auto value = [&](Program::Place place) { return held[place / 8]; };
    using Op = Operation;
    std::size_t next = 0;
    for (const Program::Group& group : program.groups_)
      for (const std::size_t end = next + group.count; next < end; ++next) {
        const Program::Instruction& it = program.instructions_[next];
        int& to = held[it.to / 8];
        if (group.first == Op::power && by_roots(numbers[value(it.b) - inputs])) {
          to = power(value(it.a), numbers[value(it.b) - inputs]);
          continue;
        }
        if (group.first == Op::sqrt) {
          to = root(value(it.a));
          continue;
        }
        if (group.first != Op::sum_of_products) {
          const bool two = operands(group.first) > 1;
          to = append({.first = group.first,
                       .second = group.second,
                       .a = value(it.a),
                       .b = two ? value(it.b) : -1,
                       .c = group.second == Op::nothing ? -1 : value(it.c)});
          continue;
        }
        int sum = -1;
        for (std::size_t k = it.a; k < it.a + it.b; ++k) {
          const auto [a, b] = std::pair{value(program.products_[k].a), value(program.products_[k].b)};
          const bool plus = is_number(a, 1.0), minus = is_number(a, -1.0);
          if (sum < 0)
            sum = plus ? b : append({.first = Op::multiply, .second = Op::nothing, .a = a, .b = b});
          else if (plus || minus)
            sum = append({.first = plus ? Op::add : Op::subtract, .second = Op::nothing, .a = sum, .b = b});
          else
            sum = append({.first = Op::multiply, .second = Op::add, .a = a, .b = b, .c = sum});
        }
        to = sum;
      }
    int out = 0;
    if (scaled)
      for (const Program::Place slope : program.slopes_)
        lines.push_back({.first = Op::nothing, .second = Op::nothing, .a = value(slope), .out = out++});
    else
      lines.push_back({.first = Op::nothing, .second = Op::nothing, .a = value(program.value_), .out = 0});
  }
  int append(const Line& line) {
    lines.push_back(line);
    return values() - 1;
  }
  int append(Operation operation, int a, int b = -1) {
    return append({.first = operation, .second = Operation::nothing, .a = a, .b = b});
  }
  /// Returns a result that all powers of a value share, made at its first use.
  int known(std::vector<int>& of, int value, Operation operation, int a, int b = -1) {
    of.resize(std::max<std::size_t>(of.size(), value + 1), -1);
    if (of[value] < 0) of[value] = append(operation, a, b);
    return of[value];
  }
  int root(int x) { return known(roots_, x, Operation::sqrt, x); }
  int reciprocal(int x) { return known(reciprocals_, x, Operation::divide, one_, x); }

  /// Returns true if roots and products serve for an exponent, see pow() of a Pack.
  static bool by_roots(double exponent) {
    const double four = 4.0 * exponent;
    return std::abs(four) <= 32.0 && four == std::trunc(four);
  }
  /// Adds the operations of a power, as pow() of a Pack does them.
  int power(int x, double exponent) {
    const double four = 4.0 * exponent;
    const int m = static_cast<int>(std::abs(four));
    const bool shares = four < 0.0 && four > -8.0 && m % 4;
    int y = -1, factor = x;
    const auto times = [&](int other) { y = y < 0 ? other : append(Operation::multiply, y, other); };
    if (m % 4) {
      if (shares)
        factor = reciprocal(root(x));
      else if (m % 4 > 1)
        times(root(x));
      if (m % 2) times(root(root(x)));
    }
    for (int k = shares ? (m + 1) / 2 : m / 4; k > 0; k /= 2) {
      if (k % 2) times(factor);
      if (k > 1) factor = append(Operation::multiply, factor, factor);
    }
    if (y < 0) y = one_;
    return four < 0.0 && !shares ? reciprocal(y) : y;
  }

  /// Sorts the lines: each comes as soon as its operands are known, and of the lines that are ready, the one
  /// that became so last comes first.
  void sort() {
    const int count = static_cast<int>(lines.size()), first = first_result();
    std::vector<int> missing(count, 0), begin(count + 1, 0), users;
    const auto each_operand = [&](int i, const auto& use) {
      for (const int value : {lines[i].a, lines[i].b, lines[i].c})
        if (value >= first) use(value - first);
    };
    for (int i = 0; i < count; ++i)
      each_operand(i, [&](int from) { ++missing[i], ++begin[from + 1]; });
    for (int i = 0; i < count; ++i)
      begin[i + 1] += begin[i];
    users.resize(begin[count]);
    std::vector<int> end(begin.begin(), begin.end() - 1);
    for (int i = 0; i < count; ++i)
      each_operand(i, [&](int from) { users[end[from]++] = i; });
    std::vector<int> ready;
    for (int i = count; i-- > 0;)
      if (missing[i] == 0) ready.push_back(i);
    order.reserve(count);
    while (!ready.empty()) {
      const int i = ready.back();
      ready.pop_back();
      order.push_back(i);
      for (int use = begin[i + 1]; use-- > begin[i];)
        if (--missing[users[use]] == 0) ready.push_back(users[use]);
    }
  }

  int one_;                               // the number 1
  std::vector<int> roots_, reciprocals_;  // roots and reciprocals of each value, or -1
};

}  // namespace avi::detail
