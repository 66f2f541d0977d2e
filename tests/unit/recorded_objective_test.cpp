#include "avi/optim/recorded_objective.hpp"

#include "avi/optim/minimise.hpp"
#include "refusal.hpp"
#include "unit/objectives.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace recorded_objective_test {

using avi::VectorX, objectives::valley;

TEST(RecordedObjective, ServesSeveralThreadsAtATime) {
  const avi::RecordedObjective shared(valley, 100);
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      const avi::RecordedObjective own = shared;
      for (int i = 0; i < 10'000; ++i) {
        const VectorX x = VectorX::Constant(100, 0.1 * k + 4e-5 * i);
        VectorX g, expected;
        const bool same = shared(x, g) == own(x, expected) && g == expected;
        wrong[k] += same ? 0 : 1;
      }
    });
  for (std::thread& each : threads)
    each.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));  // some of them are, where all threads work in one memory
}

TEST(RecordedObjective, ACopyMadeDuringACallIsNotInUse) {
  const avi::RecordedObjective first(valley, 3);
  avi::RecordedObjective second = first;
  second = first;
  VectorX g, h;
  EXPECT_EQ(first(VectorX::Ones(3), g), second(VectorX::Ones(3), h));
  EXPECT_EQ(g, h);
}

TEST(RecordedObjective, OutlivesAMove) {
  avi::RecordedObjective first(valley, 3);
  const avi::RecordedObjective second = std::move(first);
  VectorX g, h;
  EXPECT_EQ(first(VectorX::Ones(3), g), second(VectorX::Ones(3), h));  // NOLINT: after the move
  EXPECT_EQ(g, h);
}

TEST(RecordedObjective, RefusesAPointOfAnotherSize) {
  const avi::RecordedObjective f(valley, 3);
  VectorX g;
  for (const int n : {0, 2, 4})
    EXPECT_EQ(refusal([&] { (void)f(VectorX::Ones(n), g); }),
              "Size of x is " + std::to_string(n) + "; it must be the number of arguments of f, 3.");
  EXPECT_NE(refusal([&] { (void)avi::minimise(f, {1.0, 2.0}); }), "accepted");
}

}  // namespace recorded_objective_test
