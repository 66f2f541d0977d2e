#include "avi/autodiff/pack.hpp"
#include "src/autodiff/reverse.hpp"
#include "src/autodiff/schedule.hpp"
#include "unit/random_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using avi::ExpressionGraph, avi::Operation, avi::Pack, avi::Program, avi::detail::Schedule;

namespace schedule_test {

/// The program of some nodes; those before `recorded` keep their order.
struct Drawn {
  ExpressionGraph graph{1};
  int value = -1;
  std::vector<int> slopes;
  int recorded = 0;

  explicit Drawn(unsigned seed, const std::vector<Operation>& without = {}) {
    std::mt19937 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    graph = random_graph::draw(random, 3, without);
    recorded = below(2) ? graph.size() : below(graph.size());
    value = below(4) ? below(graph.size()) : -1;
    for (int i = below(6); i >= 0; --i)
      slopes.push_back(below(graph.size()));
  }
  [[nodiscard]] Program program() const { return Schedule::program(graph, value, slopes, recorded); }
};

TEST(Schedule, ProgramsComputeWhatTheNodesAre) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Drawn drawn(seed);
    const Program program = drawn.program();
    Program::Room<double> room(program);
    for (const std::vector<double>& x : {std::vector{0.3, 1.7, -0.6}, std::vector{2.5, -0.4, 0.9}}) {
      std::copy(x.begin(), x.end(), room.arguments());
      program.run(room);
      const std::vector<double> expected = random_graph::values(drawn.graph, x);
      ASSERT_EQ(program.slopes(), static_cast<int>(drawn.slopes.size()));
      for (int i = 0; i < program.slopes(); ++i)
        ASSERT_TRUE(random_graph::alike(program.slope(room, i), expected[drawn.slopes[i]]))
            << "seed " << seed;
      if (drawn.value >= 0) {
        ASSERT_TRUE(random_graph::alike(program.value(room), expected[drawn.value])) << "seed " << seed;
      }
      EXPECT_TRUE(std::equal(x.begin(), x.end(), room.arguments())) << "arguments stay as they are";
    }
  }
}

// Sines and exponentials of packs are not those of the library, and powers take other roots.
TEST(Schedule, EveryNumberOfAPackHasTheBitsOfADouble) {
  const auto compare = [&]<int w>(unsigned seed) {
    const Program program =
        Drawn(seed, {Operation::sin, Operation::cos, Operation::exp, Operation::log, Operation::power})
            .program();
    Program::Room<double> room(program);
    Program::Room<Pack<w>> rooms(program);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < w; ++i)
        rooms.arguments()[k].set(i, 0.3 * k - 0.7 + 0.31 * i);
    program.run(rooms);
    for (int i = 0; i < w; ++i) {
      for (int k = 0; k < 3; ++k)
        room.arguments()[k] = rooms.arguments()[k][i];
      program.run(room);
      for (int k = 0; k < program.slopes(); ++k)
        ASSERT_TRUE(random_graph::alike(program.slope(rooms, k)[i], program.slope(room, k)))
            << "seed " << seed << ", number " << i << " of " << w;
    }
  };
  for (unsigned seed = 0; seed < 40; ++seed) {
    compare.operator()<2>(seed);
    compare.operator()<8>(seed);
    compare.operator()<32>(seed);
  }
}

TEST(Schedule, UsesMemoryAgain) {
  ExpressionGraph graph(1);
  int node = 0;
  for (int i = 0; i < 1000; ++i)
    node = graph.unary(i % 2 ? Operation::sin : Operation::exp, node);
  const Program program = Schedule::program(graph, node, {}, graph.size());
  EXPECT_EQ(program.operations(), 1000u);
  EXPECT_LE(program.slots(), 3u);
}

// A formula far too deep and too wide for anything that calls itself for each of its parts, with its
// gradient.
TEST(Schedule, TakesFormulasOfAnyDepth) {
  const int n = 100000;
  ExpressionGraph graph(2);
  int deep = 0, sum = 1;
  for (int i = 0; i < n; ++i) {
    deep = graph.unary(Operation::sin, graph.binary(Operation::add, deep, 1));
    sum = graph.binary(Operation::add, sum, graph.binary(Operation::multiply, deep, 0));
  }
  const int recorded = graph.size();
  const std::vector<int> slopes = avi::detail::Reverse(graph).gradient(sum);
  EXPECT_LE(graph.size(), 4 * recorded);
  const Program program = Schedule::program(graph, sum, slopes, recorded);
  Program::Room<double> room(program);
  room.arguments()[0] = 0.5, room.arguments()[1] = 0.25;
  program.run(room);
  EXPECT_TRUE(random_graph::alike(program.value(room), random_graph::values(graph, {0.5, 0.25})[sum]));
  EXPECT_TRUE(std::isfinite(program.slope(room, 0)));
}

}  // namespace schedule_test
