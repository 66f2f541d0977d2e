#include "avi/avi.hpp"
#include "refusal.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using avi::Crossing, avi::Event, avi::Kepler, avi::Outcome, avi::State, systems::at, systems::pendulum;

namespace events_test {

/// The times of `count` events, each found by a run that starts where the last one ended.
template <class M>
std::vector<double> section(M method, State<2> z, double h, Crossing crossing, int count,
                            double tolerance = 0.0) {
  const Event event{[](const State<2>& at) { return at.q[0]; }, crossing, tolerance};
  std::vector<double> times;
  for (int k = 0; k < count; ++k) {
    const auto run = avi::integrate_to(method, z, h, event, {.time = z.t + (h > 0.0 ? 50.0 : -50.0)});
    EXPECT_TRUE(run.ok()) << run.message;
    EXPECT_LE(std::abs(z.q[0]), std::max(tolerance, 1e-15));
    if (crossing != Crossing::either) {
      EXPECT_GE(crossing == Crossing::rising ? z.q[0] : -z.q[0], 0.0) << "before the event";
    }
    times.push_back(z.t);
  }
  return times;
}

TEST(Events, AreFoundOnceWhereARunGoesOnFromTheLastOne) {
  const State<2> start{.q = {0.1, 0.2}, .p = {0.35, 0.1}};
  for (const int order : {2, 4, 8, 16})
    for (const double h : {0.3, -0.3})
      for (const Crossing crossing : {Crossing::rising, Crossing::falling, Crossing::either}) {
        const auto method = avi::collocation(avi::poincare(avi::HenonHeiles{}, start), order);
        const auto times = section(method, start, h, crossing, 80);
        // The same crossings as one run sees.
        std::vector<double> seen;
        auto z = start;
        auto fresh = method;
        const Event event{[](const State<2>& at) { return at.q[0]; }, crossing};
        (void)avi::integrate(fresh, z, h, {.time = times.back() + (h > 0.0 ? 0.5 : -0.5)},
                             avi::on_event(event, [&](const State<2>& at) { seen.push_back(at.t); }));
        ASSERT_GE(seen.size(), times.size());
        // By a method of low order steps of another phase lead elsewhere.
        for (std::size_t k = 0; order >= 8 && k < times.size(); ++k)
          EXPECT_NEAR(times[k], seen[k], 2e-2) << order << ' ' << h << ' ' << k;
        for (std::size_t k = 1; k < times.size(); ++k)
          EXPECT_GT(std::abs(times[k] - times[k - 1]), 0.1) << order << ' ' << h;
      }
}

TEST(Events, WithAToleranceAreFoundOnce) {
  const State<2> start{.q = {0.1, 0.2}, .p = {0.35, 0.1}};
  for (const double tolerance : {1e-10, 1e-3})
    for (const double h : {0.3, 0.01, -0.3}) {
      const auto method = avi::collocation(avi::poincare(avi::HenonHeiles{}, start), 8);
      for (const Crossing crossing : {Crossing::rising, Crossing::either}) {
        const auto times = section(method, start, h, crossing, 40, tolerance);
        for (std::size_t k = 1; k < times.size(); ++k)
          EXPECT_GT(std::abs(times[k] - times[k - 1]), 0.1) << tolerance << ' ' << h;
      }
    }
}

TEST(Events, AreNotFoundAgainOnTheWayBack) {
  const State<2> start{.q = {0.1, 0.2}, .p = {0.35, 0.1}};
  const Event event{[](const State<2>& at) { return at.q[0]; }};
  for (const int order : {4, 16}) {
    auto method = avi::collocation(avi::poincare(avi::HenonHeiles{}, start), order);
    State<2> z = start;
    for (int k = 0; k < 100; ++k) {
      ASSERT_TRUE(avi::integrate_to(method, z, 0.3, event, {.time = z.t + 50.0}).ok());
      State<2> back = z;
      ASSERT_TRUE(avi::integrate_to(method, back, -0.3, event, {.time = z.t - 50.0}).ok());
      EXPECT_LT(back.t, z.t - 0.1) << k;
      int seen = 0;
      back = z;
      (void)avi::integrate(method, back, -0.1, {.steps = 2},
                           avi::on_event(event, [&](const State<2>&) { ++seen; }));
      EXPECT_EQ(seen, 0) << k;
    }
  }
}

TEST(Events, SoonAfterTheLastOneAreFound) {
  // Near its turning point the pendulum passes q = a twice, within one step or several.
  const double top = 0.9;
  const State<1> start = at(0.0, std::sqrt(2.0 * (1.0 - std::cos(top))));
  for (const double below : {1e-2, 1e-4, 1e-6, 1e-8})
    for (const double sense : {1.0, -1.0}) {
      const auto by = avi::collocation(avi::poincare<1>(pendulum, start), 16);
      const Event event{[&](const State<1>& x) { return sense * x.q[0] - (top - below); }};
      const Event turn{[](const State<1>& x) { return x.p[0]; }};
      auto method = by;
      State<1> turned = start, once = start;
      ASSERT_TRUE(avi::integrate_to(method, turned, sense * 0.1, turn, {.time = sense * 5.0}).ok());
      auto first_method = by;
      const auto first = avi::integrate_to(first_method, once, sense * 0.1 * std::sqrt(below), event,
                                           {.time = sense * 3.0, .steps = 1'000'000});
      ASSERT_TRUE(first.ok()) << first.message << below;
      for (const double h : {0.01, 0.3}) {
        auto goes_on = first_method;
        State<1> z = once;
        const auto second = avi::integrate_to(goes_on, z, sense * h, event, {.time = z.t + sense * 2.0});
        ASSERT_TRUE(second.ok()) << second.message << ' ' << below;
        EXPECT_NEAR(z.t - turned.t, turned.t - once.t, 1e-7) << below << ' ' << h;
      }
    }
}

TEST(Events, OfEveryMonotoneFunctionAreFound) {
  const auto find = [&](std::function<double(double)> g, double tolerance = 0.0) {
    State<1> z = at(0.0, 1.2);
    auto method = avi::collocation(avi::poincare<1>(pendulum, z), 16);
    const Event event{[&](const State<1>& x) { return g(x.q[0]); }, Crossing::rising, tolerance};
    const auto run = avi::integrate_to(method, z, 1.2, event, {.time = 1.9});
    return std::pair{run, z};
  };
  const auto expect_half = [&](std::function<double(double)> g, double bound = 3e-16) {
    const auto [run, z] = find(g);
    EXPECT_TRUE(run.ok()) << run.message;
    EXPECT_NEAR(z.q[0], 0.5, bound);
    EXPECT_GE(g(z.q[0]), 0.0);
    EXPECT_LE(run.evaluations, 1500) << "at about ten a step";
  };
  expect_half([](double q) { return std::exp(80.0 * q) - std::exp(40.0); });
  expect_half([](double q) { return std::exp(600.0 * q) - std::exp(300.0); });
  expect_half([](double q) { return std::cbrt(q - 0.5); });
  expect_half([](double q) { return std::tanh(1e8 * (q - 0.5)); });
  expect_half([](double q) { return 1e-200 * (q - 0.5); });
  expect_half([](double q) { return 1e200 * (q - 0.5); });
  expect_half([](double q) { return (1e6 + q) - (1e6 + 0.5); }, 6e-11);

  const auto refused = [&](std::function<double(double)> g, Outcome outcome, const std::string& why) {
    const auto [run, z] = find(g);
    EXPECT_EQ(run.outcome, outcome);
    EXPECT_NE(run.message.find(why), std::string::npos) << run.message;
    EXPECT_EQ(z.q[0], 0.0) << "the last good state";
  };
  refused([](double q) { return 1.0 / (q - 0.5); }, Outcome::not_converged, "where |g| is not small");
  refused([](double q) { return q < 0.5 ? -1.0 : 1.0; }, Outcome::not_converged, "from -1 to 1, where |g|");
  refused([](double q) { return q < 0.5 ? q - 0.5 - 1e-3 : q + 1.0; }, Outcome::not_converged, "to 1.5");
  refused([](double q) { return std::sqrt(0.25 - q * q) - 0.6; }, Outcome::non_finite,
          "g of the event is nan");
  refused([](double q) { return std::abs(q - 0.5) < 0.1 ? NAN : q - 0.5; }, Outcome::non_finite,
          "g is nan at");

  for (const double tolerance : {std::nan(""), -1.0, HUGE_VAL}) {
    const auto g = [](double q) { return q - 0.5; };
    const std::string sentence = refusal([&] { (void)find(g, tolerance); });
    EXPECT_EQ(sentence.find("Tolerance of the event is "), 0u) << sentence;
    EXPECT_EQ(sentence, refusal([&] {
                (void)avi::on_event(
                    Event{[](const State<1>& z) { return z.q[0]; }, Crossing::rising, tolerance},
                    [](const State<1>&) {});
              }));
  }
}

TEST(Events, ThatAreJumpsEndARunWithAReason) {
  State<1> z = at(0.0, 1.2);
  auto method = avi::collocation(avi::poincare<1>(pendulum, z), 16);
  const Event jump{[](const State<1>& x) { return x.q[0] < 0.5 ? -2.0 : 4.0; }};
  const auto run = avi::integrate(method, z, 0.1, {.time = 1.0}, avi::on_event(jump, [](const State<1>&) {}));
  EXPECT_EQ(run.outcome, Outcome::not_converged);
  EXPECT_NE(run.message.find("from -2 to 4, where |g| is not small"), std::string::npos) << run.message;
}

TEST(Events, OfAFunctionThatIsZeroButForRoundingEndNothing) {
  // An orbit in a plane: the third coordinate is noise.
  const double c = std::cos(0.7), s = std::sin(0.7);
  State<3> z{.q = {1.0, 0.0, 0.0}, .p = {0.0, 1.1 * c, 1.1 * s}};
  auto method = avi::collocation(avi::poincare(systems::kepler_in_space, z), 8);
  const Event across{[&](const State<3>& at) { return s * at.q[1] - c * at.q[2]; }};
  int seen = 0;
  const auto run =
      avi::integrate(method, z, 0.1, {.time = 50.0}, avi::on_event(across, [&](const State<3>&) { ++seen; }));
  EXPECT_TRUE(run.ok()) << run.message;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(avi::detail::rounding_of_entries(State<2>{.q = {1.0, -8.0}, .p = {2.0, 0.5}}), 8.0 * epsilon);
  EXPECT_EQ(avi::detail::rounding_of_entries(State<1>{.q = {0.25}, .p = {-0.5}}), 0.5 * epsilon);
}

template <class M, class S>
void expect_landing(const M& method, const S& start, double h, double t_end) {
  M fresh = method;
  S z = start;
  const auto run = avi::integrate_to(fresh, z, h, t_end);
  ASSERT_TRUE(run.ok()) << run.message;
  EXPECT_EQ(z.t, t_end) << h;
  double shown = NAN;
  M again = method;
  S passed = start;
  ASSERT_TRUE(avi::integrate(again, passed, h, {.time = t_end},
                             avi::at_times({t_end}, [&](const S& at) { shown = at.t; }))
                  .ok());
  EXPECT_EQ(shown, t_end) << h;
}

TEST(Landing, IsOnTheTimeToTheBit) {
  for (const double t0 : {0.0, 1.0, -2.0, 1e6})
    for (const double h : {0.17, 0.05, -0.17})
      for (const double span : {1e-300, 1e-12, 0.001, 1.0 / 3.0, 1.0, M_PI, 7.3}) {
        const double end = t0 + std::copysign(span, h);
        if (end == t0) continue;
        State<2> z = Kepler::pericentre(0.6);
        z.t = t0;
        expect_landing(avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::kahan_li8), z, h,
                       end);
        const auto problem = avi::poincare<2>(Kepler{}, z, avi::NormSquared{});
        expect_landing(avi::collocation(problem, 8), z, h, end);
        expect_landing(avi::collocation(problem, 16), z, h, end);
        expect_landing(avi::htvi<4>(problem), z, h, end);
      }
}

TEST(Landing, InsideAStepOnly) {
  for (const double h : {0.3, -0.3}) {
    State<2> z = Kepler::pericentre(0.6);
    auto method = avi::splitting(avi::Separable(Kepler{}), avi::compositions::strang);
    const auto look = [&](const avi::Step<decltype(method), State<2>>& step, long k) {
      if (k == 1) return;
      for (const double t : {0.9, -0.9, double{NAN}, HUGE_VAL, step.before.t - step.h * 1e-9}) {
        const std::string sentence = refusal([&] { (void)step.at(t); });
        EXPECT_TRUE(sentence.starts_with("Time inside the step is ")) << sentence;
        EXPECT_NE(sentence.find("; it must be between its ends, "), std::string::npos) << sentence;
      }
      for (const double part : {-1.0, 2.0, 1.0 + 1e-15, -1e-300, double{NAN}})
        expect_refusal([&] { (void)step.part(part); }, "it must be in [0, 1].");
      for (const State<2>* end : {&step.before, &step.after}) {
        EXPECT_EQ(step.at(end->t).state, *end);
        EXPECT_EQ(step.part(end == &step.before ? 0.0 : 1.0).state, *end);
      }
      const double beyond = std::nextafter(step.after.t, 2.0 * step.after.t);
      EXPECT_EQ(step.at(beyond).state.t, beyond);
    };
    EXPECT_TRUE(avi::integrate(method, z, h, {.steps = 2}, look).ok());
  }
}

}  // namespace events_test
