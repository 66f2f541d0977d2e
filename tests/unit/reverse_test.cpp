#include "avi/autodiff/pack.hpp"
#include "avi/autodiff/recording.hpp"
#include "unit/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

using avi::Pack, avi::Program, avi::Recorded, avi::Recording;

namespace reverse_test {

/// Every operation that can be recorded, at x, y > 0.
const auto formulas =
    std::tuple_cat(elementary, std::tuple{[](const auto& x, const auto& y) {
                                            using avi::power;
                                            return power(x, 1.5) - power(y, -2.5) * power(x, 3.0) +
                                                   power(x, -1.0) + power(y, -0.5) * power(x, 2.0);
                                          },
                                          [](const auto& x, const auto& y) {
                                            auto sum = x * y;  // long enough for more than one line
                                            for (int i = 0; i < 80; ++i)
                                              sum = i % 3 ? sum + (0.1 * i) * (x * (y + 1.0 * i))
                                                          : sum - (x + 0.3 * i) * y - 2.0 * (x * (0.1 * i));
                                            return sum + sum * x;
                                          },
                                          [](const auto& x, const auto& y) { return +x * +(x - y); }});

/// use(formula) for each of them.
template <class Use>
void for_each_formula(Use use) {
  std::apply([&](const auto&... formula) { (use(formula), ...); }, formulas);
}

template <class F>
Recording recorded(const F& f) {
  return Recording([&](const auto& x) -> Recorded { return f(x[0], x[1]); }, 2);
}

/// A program in numbers S, and what it computes at some arguments.
template <class S = double>
struct Place {
  const Program program;
  Program::Room<S> room{program};
  void go(const auto&... x) {
    S* argument = room.arguments();
    ((*argument++ = x), ...);
    program.run(room);
  }
  [[nodiscard]] S value() const { return program.value(room); }
  [[nodiscard]] S slope(int i) const { return program.slope(room, i); }
};

TEST(Reverse, GivesTheValueToTheLastBit) {
  int i = 0;
  for_each_formula([&](const auto& f) {
    const Recording recording = recorded(f);
    for (const Program& program : {recording.value(), recording.value_and_gradient()}) {
      Place<> here{program};
      Place<Pack<4>> pack{program};
      for (double x : {0.7, 1.3, 2.9})
        for (double y : {0.4, 1.1, 5.7}) {
          here.go(x, y), pack.go(x, y);
          EXPECT_EQ(here.value(), f(x, y)) << "formula " << i;
          EXPECT_EQ(pack.value()[3], f(Pack<4>(x), Pack<4>(y))[3]) << "formula " << i;
        }
    }
    ++i;
  });
}

TEST(Reverse, HasTheGradientOfForwardDifferentiation) {
  int i = 0;
  for_each_formula([&](const auto& f) {
    const Recording recording = recorded(f);
    for (const Program& program : {recording.gradient(), recording.value_and_gradient()}) {
      Place<> here{program};
      for (double x : {0.7, 1.3, 2.9})
        for (double y : {0.4, 1.1, 5.7}) {
          here.go(x, y);
          using P = avi::Partials<double, 2>;
          const P forward = f(P::variable(x, 0), P::variable(y, 1));
          const double scale = std::abs(forward.value) + std::abs(forward.d[0]) + std::abs(forward.d[1]);
          for (int k : {0, 1})
            EXPECT_NEAR(here.slope(k), forward.d[k], 2e-15 * scale) << "formula " << i;
        }
    }
    ++i;
  });
}

// 1 - tanh(x)^2 is lost in rounding from x = 19.07 on.
TEST(Reverse, HasTheSlopeOfTanhWhereItIsNearlyOne) {
  const auto f = [](const auto& x, const auto& y) {
    using std::tanh;
    return y * tanh(x);
  };
  Place<> here{recorded(f).gradient()};
  Place<Pack<4>> pack{here.program};
  for (const double x : {0.0, 1e-9, 0.3, 1.0, 3.0, 9.0, 15.0, 19.0, 20.0, 40.0, 300.0, 350.0})
    for (const double sign : {1.0, -1.0}) {
      here.go(sign * x, 1.0), pack.go(sign * x, 1.0);
      const double slope = 1.0 / std::cosh(x) / std::cosh(x);
      EXPECT_NEAR(here.slope(0), slope, 2e-15 * slope) << sign * x;
      EXPECT_NEAR(pack.slope(0)[2], slope, 2e-15 * slope) << sign * x;
      using One = avi::Partials<double, 1>;
      using Two = avi::Partials<One, 1>;
      const Two twice = f(Two::variable(One::variable(sign * x, 0), 0, One(1.0)), Two(1.0));
      const double second = -2.0 * std::tanh(sign * x) * slope;
      EXPECT_NEAR(twice.partial(0).value, slope, 2e-15 * slope) << sign * x;
      EXPECT_NEAR(twice.partial(0).partial(0), second, 4e-15 * std::abs(second) + 6e-16 * (x < 1.0))
          << sign * x;
    }
  for (const double x : {400.0, 1e10, 1e300}) {
    here.go(x, 1.0);
    EXPECT_EQ(here.slope(0), 0.0) << x;
  }
}

TEST(Reverse, HasTheSlopesOfPowersAtZero) {
  for (const double exponent : {0.0, 1.0, 1.25, 1.5, 2.0, 2.3, 3.0, 7.0}) {
    Place<> here{
        recorded([&](const auto& x, const auto& y) { return avi::power(x, exponent) * y; }).gradient()};
    here.go(0.0, 1.0);
    EXPECT_EQ(here.slope(0), exponent == 1.0 ? 1.0 : 0.0) << exponent;
    EXPECT_EQ(here.slope(1), exponent == 0.0 ? 1.0 : 0.0) << exponent;
  }
}

TEST(Reverse, HasTheSlopesOfPowersOfAnArgumentAtZero) {
  const auto f = [](const auto& x, const auto& y) {
    using std::pow;
    return pow(x, y);
  };
  Place<> here{recorded(f).gradient()};
  for (const double exponent : {0.0, 1.0, 1.5, 2.0, 2.3, 3.0}) {
    here.go(0.0, exponent);
    using P = avi::Partials<double, 2>;
    const P forward = f(P::variable(0.0, 0), P::variable(exponent, 1));
    EXPECT_EQ(here.slope(0), exponent == 1.0 ? 1.0 : 0.0) << exponent;
    EXPECT_EQ(forward.d[0], exponent == 1.0 ? 1.0 : 0.0) << exponent;
    if (exponent == 0.0) continue;  // along it there is no slope
    EXPECT_EQ(here.slope(1), 0.0) << exponent;
    EXPECT_EQ(forward.d[1], 0.0) << exponent;
  }
}

// Where an exponent passes through zero, the slope by the base is zero but does not stay so.
TEST(Reverse, HasTheSecondDerivativesOfPowersOfExponentZero) {
  const auto f = [](const auto& x, const auto& y) {
    using std::pow;
    return pow(x, y);
  };
  using P = avi::Partials<double, 2>;
  Place<P> here{recorded(f).gradient()};
  for (const double base : {0.5, 1.0, 3.0}) {
    here.go(P::variable(base, 0), P::variable(0.0, 1));
    EXPECT_EQ(here.slope(0).value, 0.0) << base;
    EXPECT_EQ(here.slope(0).d[0], 0.0) << base;
    EXPECT_NEAR(here.slope(0).d[1], 1.0 / base, 1e-15) << base;
    EXPECT_NEAR(here.slope(1).d[0], 1.0 / base, 1e-15) << base;
    EXPECT_NEAR(here.slope(1).d[1], std::pow(std::log(base), 2), 1e-15) << base;
  }
}

// Numbers are kept apart from what they multiply, and their quotients need not be numbers of the machine.
TEST(Reverse, AddsWhatIsMultipliedByNumbersFarApart) {
  struct Case {
    double a, b;
  };
  for (const Case& by : {Case{1e200, 1e-200}, Case{1e-200, 1e200}, Case{1e-309, 1.0}, Case{1.0, 1e-309}}) {
    Place<> here{
        Recording([&](const auto& x) { return by.a * (x[0] * x[1]) + by.b * (x[0] * x[2]) + by.b * x[0]; }, 3)
            .gradient()};
    const auto slope = [&](double y, double z) {
      here.go(1.0, y, z);
      return here.slope(0);
    };
    EXPECT_EQ(slope(2.0, 3.0), by.a * 2.0 + by.b * 3.0 + by.b) << by.a;
    EXPECT_EQ(slope(0.0, 3.0), by.b * 3.0 + by.b) << by.a;
  }
}

// The force k q / |q|^3 in any units: powers of two change no digit of it.
TEST(Reverse, DoesNotLeaveTheRangeOfNumbersOnTheWay) {
  const auto force = [](double unit) {
    const double k = unit * unit * unit;
    const auto h = [k](const auto& x, const auto& y) { return -k / sqrt(x * x + y * y); };
    Place<> here{recorded(h).gradient()};
    here.go(0.3 * unit, 0.4 * unit);
    return here.slope(0) / unit;
  };
  for (const int exponent : {-330, -250, -150, -50, 50, 150, 250, 330})
    EXPECT_NEAR(force(std::ldexp(1.0, exponent)), force(1.0), 1e-14) << exponent;
}

TEST(Reverse, TakesAReciprocalFromAQuotientOnlyWhereThatIsInRange) {
  const auto slope = [](const auto& f, double at) {
    Place<> here{recorded(f).gradient()};
    here.go(at, 1.0);
    return here.slope(0);
  };
  const auto tiny = [](const auto& x, const auto&) { return 1e-100 / x + 1e200 * log(x); };
  for (const double x : {1e190, 1e220, 1e230, 1e280})
    EXPECT_NEAR(slope(tiny, x), 1e200 / x, 1e-15 * (1e200 / x)) << x;
  const auto huge = [](const auto& x, const auto&) {
    return avi::select(x < 1e-200, 0.0 * x, 1e100 / x) + log(x);
  };
  EXPECT_NEAR(slope(huge, 1e-215), 1e215, 1e200);
}

TEST(Reverse, HasTheSlopesOfAnAngleAtAnyDistance) {
  Place<> here{recorded([](const auto& x, const auto& y) { return atan2(x, y); }).gradient()};
  for (const double r : {1e-300, 1e-155, 1.0, 1e160, 1e300}) {
    here.go(r, r);
    EXPECT_NEAR(here.slope(0), 0.5 / r, 1e-15 / r) << r;
    EXPECT_NEAR(here.slope(1), -0.5 / r, 1e-15 / r) << r;
  }
}

// Where a formula branches, the other side may have no value, or an infinite slope.
TEST(Reverse, LeavesOutTheSideThatIsNotTaken) {
  const auto f = [](const auto& x, const auto& y) {
    using avi::select, std::sqrt, std::log, std::max;
    const auto root = sqrt(x), logarithm = log(y);
    return select(x > 0.0, root * root * root + select(y > 0.0, root * logarithm, -y), x * x + 3.0 * y) +
           max(0.0 * x, root) + select(x > 0.0 && y > 0.0, x / root, 1.0);
  };
  struct Case {
    double x, y, d_dx, d_dy;
  };
  const double l = std::log(3.0);
  for (const Case& is :
       {Case{4.0, 3.0, 3.0 + 0.25 * l + 0.25 + 0.25, 2.0 / 3.0}, Case{4.0, -3.0, 3.0 + 0.25, -1.0},
        Case{-4.0, 3.0, -8.0, 3.0}, Case{-4.0, -3.0, -8.0, 3.0}}) {
    Place<> here{recorded(f).value_and_gradient()};
    here.go(is.x, is.y);
    EXPECT_EQ(here.value(), f(is.x, is.y)) << is.x << ", " << is.y;
    EXPECT_NEAR(here.slope(0), is.d_dx, 1e-14) << is.x << ", " << is.y;
    EXPECT_NEAR(here.slope(1), is.d_dy, 1e-14) << is.x << ", " << is.y;
  }
}

TEST(Reverse, TreatsEachNumberOfAPackAlike) {
  for_each_formula([&](const auto& f) {
    Place<> here{recorded(f).value_and_gradient()};
    Place<Pack<8>> pack{here.program};
    Pack<8> x, y;
    for (int i = 0; i < 8; ++i)
      x.set(i, 0.5 + 0.3 * i), y.set(i, 3.0 - 0.2 * i);
    pack.go(x, y);
    for (int i = 0; i < 8; ++i) {
      here.go(0.5 + 0.3 * i, 3.0 - 0.2 * i);
      // pow of a pack takes roots where that of a double does not
      EXPECT_NEAR(pack.value()[i], here.value(), 1e-14 * std::abs(here.value()));
      EXPECT_NEAR(pack.slope(1)[i], here.slope(1), 1e-13 * std::abs(here.slope(1)));
    }
  });
}

}  // namespace reverse_test
