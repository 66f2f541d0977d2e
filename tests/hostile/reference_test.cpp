#include "hostile/formulas.hpp"
#include "hostile/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// @file
/// The reference and the verdicts: what judges others is judged here.

namespace hostile {

namespace {

System spring(double frequency, double t_end) {
  System s;
  s.family = "spring";
  s.formula = Formula::polynomial;
  s.n = 1;
  s.c = {0.5, 0.5 * frequency * frequency};
  s.k = {2, 1, 1, 2, 0, 0};
  s.unit = {1.0};
  s.q = {1.0}, s.p = {0.0}, s.q_scale = {1.0}, s.p_scale = {frequency};
  s.t_end = t_end;
  return s;
}

// Right but for `error` of the range of q, and for `claimed`.
Answer answer(const System& s, const Truth& truth, double error, double claimed, bool kept) {
  Answer a;
  a.returned = a.ok = true;
  a.kept = kept;
  a.state_error = claimed;
  a.q = {static_cast<double>(truth.end[0] + static_cast<Real>(error) * truth.range[0])};
  a.p = {static_cast<double>(truth.end[1])};
  a.t = s.t_end;
  return a;
}

TEST(Reference, Spring) {
  for (const double frequency : {1.0, 10.0, 100.0}) {
    const System s = spring(frequency, 30.0);
    const Orbit orbit = Reference(s).run(1e-17L, 1e9);
    ASSERT_EQ(orbit.ending, Ending::solved);
    const Real angle = static_cast<Real>(frequency) * 30;
    EXPECT_NEAR(static_cast<double>(orbit.end[0] - std::cos(angle)), 0.0, 4e-18 * static_cast<double>(angle));
    EXPECT_NEAR(static_cast<double>(orbit.end[1] / static_cast<Real>(frequency) + std::sin(angle)), 0.0,
                4e-18 * static_cast<double>(angle));
  }
}

TEST(Reference, EllipseOfEccentricity099) {  // back at the start after each turn
  System s;
  s.formula = Formula::kepler;
  s.n = 2;
  s.c = {0.0}, s.k = {0}, s.unit = {1.0, 1.0};
  const double e = 0.99;
  s.q = {1.0 + e, 0.0}, s.p = {0.0, std::sqrt((1.0 - e) / (1.0 + e))};
  s.q_scale = s.p_scale = {1.0, 1.0};
  // The period of the start as it is rounded, up to the rounding of t_end.
  const Real h = static_cast<Real>(s.p[1]) * s.p[1] / 2 - 1 / static_cast<Real>(s.q[0]), a = -1 / (2 * h);
  s.t_end = static_cast<double>(2 * std::acos(-1.0L) * a * std::sqrt(a));
  const Orbit orbit = Reference(s).run(1e-17L, 1e9);
  ASSERT_EQ(orbit.ending, Ending::solved);
  EXPECT_NEAR(static_cast<double>(orbit.end[0] - s.q[0]), 0.0, 3e-14);
  EXPECT_NEAR(static_cast<double>(orbit.end[1]), 0.0, 3e-14);
}

TEST(Reference, FallIntoTheCentreIsSingular) {
  System s;
  s.formula = Formula::kepler;
  s.n = 2;
  s.c = {0.0}, s.k = {0}, s.unit = {1.0, 1.0};
  s.q = {1.0, 0.0}, s.p = {0.0, 0.0}, s.q_scale = s.p_scale = {1.0, 1.0};
  s.t_end = 2.0;  // it gets there at 1.11
  EXPECT_EQ(Reference(s).run(1e-17L, 1e9).ending, Ending::singular);
}

TEST(Reference, JumpsOverNoWall) {  // from ten thousand widths away, where the potential is flat
  for (const double width : {0.1, 0.003, 0.001}) {
    System s;
    s.formula = Formula::scatterers;
    s.n = 1;
    s.c = {0.0, 10.0, width, 0.0}, s.k = {0, 1}, s.unit = {1.0};
    s.q = {-30.0}, s.p = {1.0}, s.q_scale = {1.0}, s.p_scale = {1.0};
    s.t_end = 70.0;
    s.reach = 30.0 * width;
    const Orbit orbit = Reference(s).run(3e-16L, 1e9);
    EXPECT_NEAR(static_cast<double>(orbit.end[1]), -1.0, 1e-13) << width;
  }
}

TEST(Reference, GradientsAreThoseOfDifferences) {  // of every family
  for (int index = 0; index < 150; ++index) {
    System s = draw(7, index, 1.0);
    std::vector<Number> q, p;
    Tape tape(2 * s.n);
    for (int i = 0; i < s.n; ++i)
      q.emplace_back(tape, i), p.emplace_back(tape, s.n + i);
    tape.finish(s(q, p).entry());
    Vector z, value, adjoint;
    for (const auto* x : {&s.q, &s.p})
      z.insert(z.end(), x->begin(), x->end());
    Vector slope(z.size());
    tape.gradient(z.data(), slope.data(), value, adjoint);
    const auto h = [&](const Vector& at) {
      const auto n = static_cast<std::ptrdiff_t>(s.n);
      return s(Vector(at.begin(), at.begin() + n), Vector(at.begin() + n, at.end()));
    };
    for (std::size_t i = 0; i < z.size(); ++i) {
      const auto n = static_cast<std::size_t>(s.n);
      const Real unit = i < n ? s.unit[i] : s.action / s.unit[i - n],
                 step = 1e-6L * std::min(unit, std::max(std::abs(z[i]), 1e-3L * unit));
      Vector up = z, down = z;
      up[i] += step, down[i] -= step;
      const Real difference = (h(up) - h(down)) / (2 * step);
      const Real size = std::abs(h(z)) / unit + std::abs(slope[i]) + s.energy / unit;
      EXPECT_NEAR(static_cast<double>((slope[i] - difference) / size), 0.0, 2e-9)
          << s.family << " " << index << " entry " << i << "; " << s.note;
    }
  }
}

TEST(Draw, IsTheSameAgainAndFinite) {
  for (int index = 0; index < 300; ++index) {
    const System a = draw(3, index, 300.0), b = draw(3, index, 300.0);
    EXPECT_EQ(a.q, b.q);
    EXPECT_EQ(a.note, b.note);
    const double energy = a(a.q, a.p);
    EXPECT_TRUE(std::isfinite(energy)) << a.family << " " << index << "; " << a.note;
    EXPECT_LT(a.t, a.t_end);
  }
}

TEST(Judge, Verdicts) {
  const System s = spring(1.0, 20.0);
  const Truth known = truth(s, 1e9);
  ASSERT_TRUE(known.good_for(1e-12));
  const auto verdict = [&](const Answer& a, double tolerance) {
    return name(judge(s, known, a, tolerance, 10.0).verdict);
  };
  EXPECT_STREQ(verdict(answer(s, known, 0.0, 0.0, true), 1e-12), "right");
  EXPECT_STREQ(verdict(answer(s, known, 9e-7, 0.0, true), 1e-8), "right");
  EXPECT_STREQ(verdict(answer(s, known, 1.1e-6, 0.0, true), 1e-8), "beyond");
  EXPECT_STREQ(verdict(answer(s, known, 0.02, 0.0, true), 1e-8), "WRONG");
  EXPECT_STREQ(verdict(answer(s, known, 5e-8, 1e-3, false), 1e-8), "shy");
  EXPECT_STREQ(verdict(answer(s, known, 0.02, 1e-3, false), 1e-8), "said");
  EXPECT_STREQ(verdict(answer(s, known, 0.02, 1e-5, false), 1e-8), "told less");
  Answer nothing = answer(s, known, std::nan(""), 0.0, true);
  EXPECT_STREQ(verdict(nothing, 1e-8), "WRONG");
  nothing.ok = nothing.kept = false;
  EXPECT_STREQ(verdict(nothing, 1e-8), "refused");
  nothing.ok = true, nothing.t = 10.0;
  EXPECT_STREQ(verdict(nothing, 1e-8), "WRONG");
  nothing.too_slow = true;
  EXPECT_STREQ(verdict(nothing, 1e-8), "slow");
  nothing.crashed = true;
  EXPECT_STREQ(verdict(nothing, 1e-8), "CRASH");
}

}  // namespace

}  // namespace hostile
