#include "avi/collocation/stage_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stage_values_test {

// Against a type of twice the digits.
template <int w>
void adds_to_twice_the_digits() {
  __extension__ using Quad = __float128;
  std::mt19937_64 random(w);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  double sum = 0.75, low = 3e-17, worst = 0.0;
  Quad exact = Quad(sum) + low;
  for (int step = 0; step < 1000; ++step) {
    avi::Pack<w> terms, rests;
    for (int i = 0; i < w; ++i) {
      terms.set(i, std::ldexp(number(random), -4 * (step % 3)));
      rests.set(i, std::ldexp(number(random), -55));
      exact += Quad(terms[i]) + rests[i];
    }
    avi::add_all(sum, low, terms, rests);
    EXPECT_EQ(sum + low, sum) << "no more than what rounding cuts off";
    worst = std::max(worst, std::abs(static_cast<double>(Quad(sum) + low - exact)));
  }
  EXPECT_LT(worst, 2e-28) << w;
}

TEST(AddAll, KeepsTwiceTheDigits) {
  adds_to_twice_the_digits<2>();
  adds_to_twice_the_digits<4>();
  adds_to_twice_the_digits<8>();
  adds_to_twice_the_digits<16>();
}

TEST(AddWithRest, LosesNothingWhicheverIsLarger) {
  for (const auto& [first, second] : {std::pair{1e20, 3.0}, {3.0, 1e20}, {-1.0, 0x1p-60}}) {
    double sum = first, rest = 0.25;
    avi::add_with_rest(sum, rest, second);
    EXPECT_EQ(sum, first + second);
    EXPECT_EQ(rest, 0.25 + (std::abs(first) > std::abs(second) ? second : first) -
                        (sum - (std::abs(first) > std::abs(second) ? first : second)));
  }
}

}  // namespace stage_values_test
