#include "common/power_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

// The law of Bregman dynamics for a homogeneous f = |x|^k / k (docs/optimisation.md): f falls like t^-rate
// with
//   rate = 3 p k / (k + 2) for k <= 4, p k / (k - 2) for k >= 4.

namespace homogeneous_rate_test {

/// Slope of log f's upper envelope over log t along x' = p t^(-p-1) r, r' = -C p t^(2p-1) |x|^(k-2) x, from t
/// = 1 on. Runge and Kutta's method of order 4 with a step that is a small part of the shorter of t and the
/// local period.
double measured_rate(double k, double p, double t_end) {
  const double C = 1.0;
  double t = 1.0, x = 1.0, r = 0.3, most = 0.0, most_at = 1.0, next = 1.0, amplitude = 1.0, window = 0.0;
  std::vector<double> times, maxima;
  const auto fx = [&](double at, double rr) { return p * std::pow(at, -p - 1.0) * rr; };
  const auto fr = [&](double at, double xx) {
    return -C * p * std::pow(at, 2.0 * p - 1.0) * std::pow(std::abs(xx), k - 2.0) * xx;
  };
  while (t < t_end) {
    const double frequency =
        std::sqrt(C) * p * std::pow(t, 0.5 * p - 1.0) * std::pow(amplitude, 0.5 * (k - 2.0));
    const double h = 0.03 / (frequency + 1.0 / t);
    const double x1 = fx(t, r), r1 = fr(t, x);
    const double x2 = fx(t + 0.5 * h, r + 0.5 * h * r1), r2 = fr(t + 0.5 * h, x + 0.5 * h * x1);
    const double x3 = fx(t + 0.5 * h, r + 0.5 * h * r2), r3 = fr(t + 0.5 * h, x + 0.5 * h * x2);
    const double x4 = fx(t + h, r + h * r3), r4 = fr(t + h, x + h * x3);
    x += h / 6.0 * (x1 + 2.0 * x2 + 2.0 * x3 + x4);
    r += h / 6.0 * (r1 + 2.0 * r2 + 2.0 * r3 + r4);
    t += h;
    window = std::max(window, std::abs(x));
    const double f = std::pow(std::abs(x), k) / k;
    if (f > most) most = f, most_at = t;
    if (t >= next) {
      if (std::log(most_at) > 0.5 * std::log(t_end))  // the second half
        times.push_back(most_at), maxima.push_back(most);
      amplitude = window;
      window = most = 0.0;
      next = k == 4.0 ? 10.0 * t : 1.3 * t;  // at k = 4 a period is long in log t, and stays so
    }
  }
  return -experiment::power_law(times, maxima).slope;
}

double law(double k, double p) { return k <= 4.0 ? 3.0 * p * k / (k + 2.0) : p * k / (k - 2.0); }

TEST(HomogeneousRate, IsTheExactLaw) {
  for (double p : {2.0, 3.0, 4.0})
    for (double k : {2.0, 3.0, 4.0, 6.0, 8.0}) {
      const double t_end = k == 2.0 ? std::pow(3000.0, 2.0 / p) : k < 4.0 ? 1e4 : k == 4.0 ? 1e16 : 1e6;
      const double rate = measured_rate(k, p, t_end);
      std::printf("k = %g, p = %g: %.4f, law %.4f, %.2f %%\n", k, p, rate, law(k, p),
                  100.0 * (rate / law(k, p) - 1.0));
      EXPECT_NEAR(rate, law(k, p), 0.02 * law(k, p)) << "k = " << k << ", p = " << p;
    }
}

}  // namespace homogeneous_rate_test
