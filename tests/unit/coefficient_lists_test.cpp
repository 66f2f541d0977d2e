#include "avi/integrators/coefficient_lists.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace coefficient_lists_test {

/// Largest defect of the order conditions of each degree up to `degree`.
///
/// A product of exp(a_i A) exp(b_i B) with non-commuting A, B is a series over words in A and B; it agrees
/// with exp(A + B) up to h^k when every word of length l <= k has the coefficient 1 / l!. Word w of length l
/// has index 2^l - 1 + (its letters as bits, the last letter lowest).
std::vector<long double> defects(const avi::SplitCoefficients& s, int degree) {
  std::vector<long double> series((2u << degree) - 1u, 0.0L);
  series[0] = 1.0L;
  const auto multiply = [&](long double x, unsigned letter) {
    // new[w] = sum_j old[w without its last j letters] x^j / j!, over the j equal letters that end w.
    for (int l = degree; l >= 1; --l)
      for (unsigned bits = 0; bits < (1u << l); ++bits) {
        long double sum = series[(1u << l) - 1u + bits], weight = 1.0L;
        unsigned rest = bits;
        for (int j = 1; j <= l && (rest & 1u) == letter; ++j) {
          rest >>= 1;
          weight *= x / static_cast<long double>(j);
          sum += weight * series[(1u << (l - j)) - 1u + rest];
        }
        series[(1u << l) - 1u + bits] = sum;
      }
  };
  for (std::size_t i = 0; i < s.b.size(); ++i) {
    multiply(s.a[i], 0u);
    multiply(s.b[i], 1u);
  }
  multiply(s.a.back(), 0u);
  std::vector<long double> worst(static_cast<std::size_t>(degree) + 1, 0.0L);
  long double exact = 1.0L;
  for (int l = 1; l <= degree; ++l) {
    exact /= static_cast<long double>(l);
    for (unsigned bits = 0; bits < (1u << l); ++bits)
      worst[static_cast<std::size_t>(l)] =
          std::max(worst[static_cast<std::size_t>(l)], std::abs(series[(1u << l) - 1u + bits] - exact));
  }
  return worst;
}

/// Every condition up to the stated order holds to `digits`; the next degree does not.
void expect_order(const avi::SplitCoefficients& s, int order, long double digits, const char* name) {
  EXPECT_EQ(s.order, order) << name;
  const auto worst = defects(s, order + 1);
  for (int l = 1; l <= order; ++l)
    EXPECT_LT(worst[static_cast<std::size_t>(l)], digits) << name << ", degree " << l;
  EXPECT_GT(worst[static_cast<std::size_t>(order) + 1], 1e-10L) << name;
  for (std::size_t i = 0; i < s.a.size(); ++i)
    EXPECT_NEAR(s.a[i], s.a[s.a.size() - 1 - i], 1e-19L) << name << " is not symmetric";
}

namespace c = avi::compositions;

TEST(Compositions, SatisfyTheOrderConditionsInExtendedPrecision) {
  const long double digits = 4e-18L;
  expect_order(split(c::strang), 2, digits, "strang");
  expect_order(split(c::yoshida4), 4, digits, "yoshida4");
  expect_order(split(c::suzuki4), 4, digits, "suzuki4");
  expect_order(split(c::yoshida6), 6, digits, "yoshida6");
  expect_order(split(c::kahan_li6), 6, digits, "kahan_li6");
  expect_order(split(c::kahan_li8), 8, digits, "kahan_li8");
  expect_order(split(c::sofroniou_spaletta10), 10, digits, "sofroniou_spaletta10");
}

TEST(Splittings, SatisfyTheOrderConditionsToTheirPrintedDigits) {
  expect_order(avi::splittings::blanes_moan4, 4, 3e-15L, "blanes_moan4");
  expect_order(avi::splittings::blanes_moan6, 6, 3e-15L, "blanes_moan6");
}

/// Error of one step of size h on the pendulum, against small steps of order 10.
long double error_on_pendulum(const avi::SplitCoefficients& s, long double h) {
  const auto end = [=](const avi::SplitCoefficients& list, int steps) {
    long double q = 0.4L, p = 1.3L;
    const long double part = h / static_cast<long double>(steps);
    for (int k = 0; k < steps; ++k) {
      for (std::size_t i = 0; i < list.b.size(); ++i) {
        q += list.a[i] * part * p;
        p -= list.b[i] * part * std::sin(q);
      }
      q += list.a.back() * part * p;
    }
    return std::pair{q, p};
  };
  const auto [q, p] = end(s, 1);
  const auto [exact_q, exact_p] = end(split(c::sofroniou_spaletta10), 64);
  return std::hypot(q - exact_q, p - exact_p);
}

TEST(Splittings, ANystromListHasItsOrderWhereTheKineticEnergyIsQuadratic) {
  const auto& list = avi::splittings::blanes_moan6_nystrom;
  EXPECT_EQ(list.order, 6);
  const long double coarse = error_on_pendulum(list, 0.5L), fine = error_on_pendulum(list, 0.25L);
  EXPECT_GT(coarse, 100.0L * fine) << "by 2^7, or more where the leading term is small";
  EXPECT_LT(coarse, 2.2e-9L);  // 1.1e-9 was measured
}

TEST(Compositions, ADigitThatIsWrongShows) {
  auto wrong = split(c::kahan_li8);
  wrong.b[3] += 1e-15L;
  EXPECT_GT(defects(wrong, 8)[1], 9e-16L);
  auto swapped = c::kahan_li8;  // Sums to 1 still; only the higher conditions see it.
  std::swap(swapped.c[0], swapped.c[1]);
  EXPECT_GT(defects(split(swapped), 8)[8], 1e-6L);
}

TEST(Lengths, AreAtMostThirtySix) {
  EXPECT_EQ(avi::Lengths<double>(c::sofroniou_spaletta10.c).size(), 35u);
  EXPECT_NO_THROW(avi::Lengths<double>(36));
  EXPECT_THROW(avi::Lengths<double>(37), std::invalid_argument);
}

}  // namespace coefficient_lists_test
