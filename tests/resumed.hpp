#pragma once
#include "avi/solve.hpp"
#include "scratch.hpp"

#include <gtest/gtest.h>

/// To the last bit, on the way and at events, too.
template <int n>
void expect_same(const avi::Solution<n>& a, const avi::Solution<n>& b) {
  EXPECT_EQ(a.state, b.state) << a.choice.name;
  EXPECT_EQ(a.states, b.states);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i)
    EXPECT_EQ(a.events[i].state, b.events[i].state);
  EXPECT_EQ(a.run.steps, b.run.steps) << a.choice.name;
  EXPECT_EQ(a.run.message, b.run.message);
  EXPECT_EQ(a.choice.name, b.choice.name);
  ASSERT_EQ(a.curve != nullptr, b.curve != nullptr);
  for (const double part : {0.026, 0.5, 0.777, 0.99999})
    if (const double t = part * a.state.t; a.curve) {
      EXPECT_EQ(a(t), b(t));
    }
}

/// A run that ends after so many steps and goes on from its file is the whole one.
template <int n, class H>
void expect_to_go_on(const H& hamiltonian, const avi::State<n>& start, double end, double tolerance,
                     avi::SolveOptions options, long steps) {
  const Scratch folder;
  options.checkpoint = folder / "run";
  const auto whole = avi::solve(hamiltonian, start, end, tolerance, options);
  ASSERT_TRUE(whole.ok()) << whole.report();
  avi::SolveOptions bounded = options;
  bounded.steps = steps;
  EXPECT_EQ(avi::solve(hamiltonian, start, end, tolerance, bounded).run.outcome, avi::Outcome::step_limit);
  expect_same(avi::resume<n>(hamiltonian, options.checkpoint, options), whole);
}
