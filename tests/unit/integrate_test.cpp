#include "avi/core/integrate.hpp"

#include "avi/avi.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using avi::Outcome, avi::State;

namespace integrate_test {

/// Time goes on by `pace` times h in each step, q counts the steps; step number `bad` ends as `end`.
struct Counter {
  double pace = 1.0;
  long bad = -1;
  Outcome end = Outcome::ok;
  avi::StepReport step(State<1>& z, double h) const {
    z.q[0] += 1.0;
    z.t += pace * h;
    if (std::lround(z.q[0]) == bad) {
      if (end == Outcome::ok) z.p[0] = NAN;
      return {end, 3, 0.125};
    }
    return {.evaluations = 3};
  }
};

State<1> zero(double t = 0.0) { return {.q = {0.0}, .p = {0.0}, .t = t}; }

TEST(Integrate, RefusesEntriesThatAreNotPairs) {
  struct Pairs {
    avi::StepReport step(State<avi::dynamic>& z, double h) const {
      z.t += h;
      return {};
    }
  } method;
  for (State<avi::dynamic> z : {State<avi::dynamic>{.q = {1.0, 2.0, 3.0}, .p = {0.0}},
                                {.q = {1.0}, .p = {0.0, 1.0}},
                                State<avi::dynamic>{}}) {
    EXPECT_THROW((void)avi::integrate(method, z, 0.1, {.steps = 3}), std::invalid_argument);
    EXPECT_THROW((void)avi::integrate_to(method, z, 0.1, 1.0), std::invalid_argument);
  }
}

TEST(Integrate, EndsAfterStepsOrWhenATimeIsReached) {
  for (const double sense : {1.0, -1.0}) {
    Counter method;
    State<1> z = zero();
    avi::Run run = avi::integrate(method, z, sense * 0.25, {.steps = 7});
    EXPECT_EQ(run.outcome, Outcome::ok);
    EXPECT_EQ(run.steps, 7);
    EXPECT_EQ(run.evaluations, 21);
    EXPECT_EQ(z.q[0], 7.0);
    EXPECT_EQ(run.message, "");
    run = avi::integrate(method, z, sense * 0.25, {.time = sense * 2.0});
    EXPECT_EQ(run.outcome, Outcome::ok);
    EXPECT_EQ(run.steps, 1) << "2 is reached, not passed";
    EXPECT_EQ(z.t, sense * 2.0);
    run = avi::integrate(method, z, sense * 0.25, {.time = sense * 2.1, .steps = 100});
    EXPECT_EQ(run.steps, 1);
    EXPECT_EQ(z.t, sense * 2.25) << "the last step is not cut";
    run = avi::integrate(method, z, sense * 0.25, {.time = sense * 2.25});
    EXPECT_EQ(run.steps, 0) << "it is there already";
    run = avi::integrate(method, z, sense * 0.25, {.time = sense * 10.0, .steps = 3});
    EXPECT_EQ(run.outcome, Outcome::step_limit);
    EXPECT_EQ(run.steps, 3);
    EXPECT_EQ(run.message, std::string("The run ended as step_limit after 3 steps, at t = ") +
                               (sense > 0.0 ? "3" : "-3") + ": the cap on steps came before the end time.");
    run = avi::integrate(method, z, sense * 0.25, {.steps = 0});
    EXPECT_EQ(run.outcome, Outcome::ok);
    EXPECT_EQ(z.q[0], 12.0);
  }
}

TEST(Integrate, RefusesWhatSetsNoStepOrNoEnd) {
  Counter method;
  State<1> z = zero();
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const double h : {0.0, std::nan(""), inf, -inf})
    EXPECT_THROW((void)avi::integrate(method, z, h, {.steps = 1}), std::invalid_argument) << h;
  EXPECT_THROW((void)avi::integrate(method, z, 0.1, {}), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate(method, z, -0.1, {.time = -inf}), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate(method, z, 0.1, {.time = NAN}), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate(method, z, -0.1, {.time = 1.0}), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate(method, z, 0.1, {.time = -1.0}), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate(method, z, 0.1, {.steps = -1}), std::invalid_argument);
}

TEST(Integrate, RefusesAStartWithoutATime) {
  Counter method;
  for (const double t : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const std::string sentence = "Time of the start is " +
                                 std::string(std::isnan(t) ? "nan"
                                             : t > 0       ? "inf"
                                                           : "-inf") +
                                 "; it must be finite.";
    State<1> z = zero(t);
    EXPECT_EQ(refusal([&] { (void)avi::integrate(method, z, 0.1, {.steps = 50}); }), sentence);
    EXPECT_EQ(refusal([&] { (void)avi::integrate(method, z, 0.1, {.time = 5.0}); }), sentence);
    EXPECT_EQ(refusal([&] { (void)avi::integrate_to(method, z, 0.1, 5.0); }), sentence);
    const avi::Event event{[](const State<1>& at) { return at.q[0]; }};
    EXPECT_EQ(refusal([&] { (void)avi::integrate_to(method, z, 0.1, event, {.time = 5.0}); }), sentence);
  }
}

TEST(Integrate, EndsAfterSoManySeconds) {
  for (const double seconds : {std::nan(""), 0.0, -1.0}) {
    Counter method;
    State<1> z = zero();
    EXPECT_THROW((void)avi::integrate(method, z, 1.0, {.time = 1.0, .seconds = seconds}),
                 std::invalid_argument);
  }
  struct Slow : Counter {
    avi::StepReport step(State<1>& z, double h) const {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return Counter::step(z, h);
    }
  } slow;
  Counter fast;
  const auto check = [](auto& method, double bound) {
    State<1> z = zero();
    const auto began = std::chrono::steady_clock::now();
    const avi::Run run = avi::integrate(method, z, 1.0, {.time = 1e15, .seconds = 0.05});
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    EXPECT_EQ(run.outcome, Outcome::time_limit);
    EXPECT_FALSE(run.ok());
    EXPECT_EQ(run.message.find("The run ended as time_limit after "), 0u) << run.message;
    EXPECT_GE(took, 0.05);
    EXPECT_LT(took, bound);
    EXPECT_EQ(z.t, static_cast<double>(run.steps));
  };
  check(slow, 2.0);  // measured 0.06; another process may have the processor
  check(fast, 2.0);
  State<1> z = zero();
  EXPECT_TRUE(avi::integrate(fast, z, 1.0, {.time = 1e3, .seconds = 100.0}).ok());
}

TEST(Integrate, PassesOnTheReasonOfAnObserver) {
  Counter method;
  State<1> z = zero();
  const avi::Run run = avi::integrate(method, z, 0.5, {.steps = 10}, [](const State<1>&, long k) {
    return k < 4 ? avi::Answer{} : avi::Answer{Outcome::diverged, "it is too far out"};
  });
  EXPECT_EQ(run.outcome, Outcome::diverged);
  EXPECT_EQ(run.message, "The run ended as diverged after 4 steps, at t = 2: it is too far out.");
}

TEST(Integrate, KeepsTheLastGoodState) {
  for (const Outcome outcome : {Outcome::not_converged, Outcome::bad_monitor, Outcome::ok}) {
    Counter method{.bad = 4, .end = outcome};
    State<1> z = zero();
    std::vector<long> shown;
    const avi::Run run =
        avi::integrate(method, z, 0.5, {.steps = 10}, [&](const State<1>&, long k) { shown.push_back(k); });
    EXPECT_EQ(run.outcome, outcome == Outcome::ok ? Outcome::non_finite : outcome);
    EXPECT_EQ(run.steps, 3);
    EXPECT_EQ(run.evaluations, 9);
    EXPECT_EQ(shown, (std::vector<long>{1, 2, 3}));
    EXPECT_EQ(z.q[0], 3.0);
    EXPECT_EQ(z.t, 1.5);
    if (outcome == Outcome::not_converged) {
      EXPECT_EQ(run.message,
                "The run ended as not_converged after 3 steps, at t = 1.5, q = (3), p = (0), with "
                "residual 0.125.");
    }
  }
}

// What another observer has in its books goes on from there.
TEST(Integrate, KeepsTheLastGoodStateWhereSomethingIsThrown) {
  Counter method;
  State<1> z = zero();
  std::vector<double> times;
  const auto books = [&](const State<1>& now, long) { times.push_back(now.t); };
  const auto full = [](const State<1>&, long k) {
    if (k == 3) throw std::runtime_error("disc full");
  };
  EXPECT_THROW((void)avi::integrate(method, z, 0.5, {.steps = 10}, books, full), std::runtime_error);
  EXPECT_EQ(times, (std::vector{0.5, 1.0, 1.5}));
  EXPECT_EQ(z.t, 1.5);
  struct {
    avi::StepReport step(State<1>& now, double h) const {
      if (now.t >= 2.0) throw std::runtime_error("no number");
      now.t += h;
      return {.evaluations = 1};
    }
  } fails;
  EXPECT_THROW((void)avi::integrate(fails, z, 0.5, {.steps = 10}), std::runtime_error);
  EXPECT_EQ(z.t, 2.0);
}

/// Free up to a half, where the force is infinite.
struct Wall {
  static constexpr int dimension = 1;
  using Vec = avi::Vector<double, 1>;
  static double potential(const Vec&) { return 0.0; }
  static Vec potential_gradient(const Vec& q) { return Vec(q[0] > 0.5 ? HUGE_VAL : 0.0); }
};
struct Nowhere : Wall {
  static Vec potential_gradient(const Vec&) { return Vec(HUGE_VAL); }
};

TEST(Integrate, SaysWhyAStepFailed) {
  const auto message = [](auto method) {
    State<1> z{.q = {0.0}, .p = {1.0}};
    return avi::integrate(method, z, 1.0, {.steps = 10}).message;
  };
  const auto failed = [](const char* outcome, const char* why) {
    return std::string("The run ended as ") + outcome + " after 0 steps, at t = 0: " + why + ".";
  };
  const auto end = [&](Outcome outcome) { return message(Counter{.bad = 1, .end = outcome}); };
  EXPECT_EQ(end(Outcome::bad_monitor), failed("bad_monitor", "g = dt/dtau is not positive in the next step"));
  EXPECT_EQ(end(Outcome::diverged),
            failed("diverged", "the next step leads where the method is not defined"));
  EXPECT_EQ(end(Outcome::non_finite), failed("non_finite", "a number in the next step is not finite"));
  const std::string in_p = failed("non_finite", "after the next step p[0] is not finite");
  const auto verlet = avi::stormer_verlet<1>(&Wall::potential_gradient);
  EXPECT_EQ(message(verlet), in_p);
  EXPECT_EQ(message(avi::Composition(verlet, avi::compositions::strang)), in_p);
  // Of several the first.
  const std::string in_q = failed("non_finite", "after the next step q[0] is not finite");
  EXPECT_EQ(message(avi::splitting(avi::Separable(Wall{}), avi::compositions::yoshida4)), in_q);
  EXPECT_EQ(message(avi::EulerB<1, Nowhere>(Nowhere{}, avi::Unit{}, 0.0)), in_q);
}

TEST(Integrate, TakesNoNegativeResidualForAnEntry) {
  struct Fails {
    avi::StepReport step(State<1>&, double) const { return {Outcome::non_finite, 1, -2.0}; }
  } method;
  State<1> z{.q = {0.0}, .p = {1.0}};
  EXPECT_NE(avi::integrate(method, z, 0.5, {.steps = 10}).message.find("a number in the next step is not"),
            std::string::npos);
  const auto report = avi::stormer_verlet<1>(&Nowhere::potential_gradient).step(z, 0.5);
  EXPECT_EQ(report.bad_entry, 0);
  EXPECT_EQ(report.residual, 0.0);
}

TEST(Integrate, SaysWhereItEndedWithEveryDigit) {
  struct Fails {
    avi::StepReport step(State<2>&, double) const { return {Outcome::not_converged, 1, 0.1}; }
  } method;
  State<2> z{.q = {0.1, 2.0}, .p = {3.0, 4.0}, .t = 0.1};
  EXPECT_EQ(avi::integrate(method, z, 0.5, {.steps = 10}).message,
            "The run ended as not_converged after 0 steps, at t = 0.1, q = (0.1 2), "
            "p = (3 4), with residual 0.1.");
}

TEST(Integrate, AsksEveryObserver) {
  Counter method;
  State<1> z = zero();
  long states = 0, steps = 0;
  const avi::Run run = avi::integrate(
      method, z, 0.5, {.steps = 10}, [&](const State<1>& now, long k) { states += now.q[0] == k; },
      [&](const avi::Step<Counter, State<1>>& step, long k) {
        steps += step.before.q[0] == k - 1 && step.after.q[0] == k && step.h == 0.5;
        return k < 4;
      },
      [](const State<1>&, long k) { return k < 4 ? Outcome::ok : Outcome::diverged; });
  EXPECT_EQ(run.outcome, Outcome::stopped) << "the first answer that is not ok";
  EXPECT_EQ(run.steps, 4);
  EXPECT_EQ(states, 4);
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(avi::integrate(method, z, 0.5, {.steps = 9},
                           [](const State<1>&, long k) { return k < 2 ? Outcome::ok : Outcome::diverged; })
                .outcome,
            Outcome::diverged);
}

TEST(Integrate, EndsARunThatWouldNeverArrive) {
  // After a million steps the rest is over 2^53 steps away; at half of that distance it is not.
  const auto run = [](double pace, double h, double end) {
    Counter method{.pace = pace};
    State<1> z = zero();
    return avi::integrate(method, z, h, {.time = end, .steps = (1L << 20) + 1});
  };
  const double steps = std::ldexp(1.0, 53);
  for (const double sense : {1.0, -1.0}) {
    EXPECT_EQ(run(1.0, sense, sense * steps * 2.0).outcome, Outcome::stalled);
    EXPECT_EQ(run(1.0, sense, sense * steps * 2.0).steps, 1L << 20);
    EXPECT_EQ(run(1.0, sense, sense * steps * 0.5).outcome, Outcome::step_limit);
    EXPECT_EQ(run(-1.0, sense, sense).outcome, Outcome::stalled) << "it goes the other way";
    for (const double end : {0x1p20, 0x1p20 - 0.5})
      EXPECT_TRUE(run(1.0, sense, sense * end).ok()) << "it looks up where it arrives: " << sense * end;
  }
}

// About every millisecond: after ever more steps that take no time at all, and after fewer where they do.
TEST(Integrate, ReadsTheClockAfterManyShortSteps) {
  const avi::Until until{.seconds = 1000.0};
  avi::detail::Lookout slow(until, 0.0);
  for (int reads = 0; reads < 10; ++reads)
    EXPECT_TRUE(slow.look(slow.next(), 0.0).ok());
  const long first = slow.next();
  EXPECT_TRUE(slow.look(first, 0.0).ok());
  const long second = slow.next();
  std::this_thread::sleep_for(std::chrono::milliseconds(4));
  EXPECT_TRUE(slow.look(second, 0.0).ok());
  EXPECT_LT(slow.next() - second, std::max(second - first, 2L));
  avi::detail::Lookout lookout(until, 0.0);
  EXPECT_EQ(lookout.next(), 1);
  long longest = 0;
  for (int reads = 0; reads < 30; ++reads) {
    const long now = lookout.next();
    EXPECT_TRUE(lookout.look(now, 0.0).ok());
    longest = std::max(longest, lookout.next() - now);
  }
  EXPECT_GT(longest, 1000);
  EXPECT_LE(longest, avi::detail::Lookout::patience);
  const long due = lookout.next();
  EXPECT_TRUE(lookout.look(1, 0.0).ok());
  EXPECT_EQ(lookout.next(), due) << "not read yet";
}

}  // namespace integrate_test
