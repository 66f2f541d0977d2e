#include "avi/autodiff/dual_number.hpp"
#include "avi/autodiff/partials.hpp"
#include "difference.hpp"
#include "unit/elementary.hpp"

#include <gtest/gtest.h>

#include <string>

using avi::DualNumber, avi::Partials;

namespace dual_number_test {

TEST(DualNumber, PartialsAgreeWithCentralDifferences) {
  const double x = 0.7, y = 1.3;
  int i = 0;
  const auto check = [&](const auto& f) {
    SCOPED_TRACE("operation " + std::to_string(i++));
    const double value = f(x, y);
    const DualNumber<2> v = f(DualNumber<2>::variable(x, 0), DualNumber<2>::variable(y, 1));
    EXPECT_NEAR(v.value(), value, 4e-16 * std::abs(value));
    EXPECT_NEAR(v.partial(0), difference([&](double d) { return f(x + d, y); }, 1e-3), 2e-9);
    EXPECT_NEAR(v.partial(1), difference([&](double d) { return f(x, y + d); }, 1e-3), 2e-9);
    using P = Partials<double, 2>;
    const P p = f(P::variable(x, 0), P::variable(y, 1));
    EXPECT_NEAR(p.value, v.value(), 4e-16 * std::abs(v.value()));
    EXPECT_NEAR(p.partial(0), v.partial(0), 1e-14);
    EXPECT_NEAR(p.partial(1), v.partial(1), 1e-14);
  };
  std::apply([&](const auto&... f) { (check(f), ...); }, elementary);
}

/// Where the function has a derivative at zero, or one on each side.
template <class S>
void check_at_zero(S x) {
  using std::abs, avi::power;
  const auto slope = [](const S& f) { return f.partial(0); };
  EXPECT_EQ(slope(pow(x, 0.0)), 0.0);
  EXPECT_EQ(slope(pow(x, 1.0)), 1.0);
  EXPECT_EQ(slope(pow(x, 1.5)), 0.0);
  EXPECT_EQ(slope(pow(x, 2.0)), 0.0);
  EXPECT_EQ(slope(power(x, 3.0)), 0.0);
  EXPECT_EQ(slope(abs(x)), 0.0) << "the mean of both sides";
  EXPECT_EQ(slope(min(x, S(0.0))), 0.5);
  EXPECT_EQ(slope(max(S(0.0), 3.0 * x)), 1.5);
  EXPECT_EQ(slope(max(x, 2.0 * x)), 1.5);
  EXPECT_EQ(max(x, S(std::nan(""))) < 1.0, true) << "as std::max, which gives the first of the two";
}

TEST(DualNumber, DerivativesAtZero) {
  check_at_zero(DualNumber<2>::variable(0.0, 0));
  check_at_zero(Partials<double, 2>::variable(0.0, 0));
}

TEST(DualNumber, ProductSumIsTheSumOfProducts) {
  const auto x = DualNumber<3>::variable(1.5, 0), y = DualNumber<3>::variable(-0.25, 2);
  avi::ProductSum<DualNumber<3>> sum;
  sum.add(x, y);
  sum.add(y, y, 2.0);
  const auto expected = x * y + 2.0 * y * y, result = sum.result();
  EXPECT_EQ(result.value(), expected.value());
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(result.partial(i), expected.partial(i));
}

}  // namespace dual_number_test
