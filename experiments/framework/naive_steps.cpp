#include "avi/collocation/collocation.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"
#include "common/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

// The sentence with which the paper begins: variable steps in a symplectic integrator lose what makes it one.
// Kepler's orbit of eccentricity 0.9 with the same method of order 4 and the same number of steps for each
// orbit: steps h g(z_n) put in by hand, steps from an estimate of the error, and constant steps of the
// transformed problem.

namespace {

using namespace experiment;
using State2 = avi::State<2>;

constexpr double eccentricity = 0.9, period = 2.0 * M_PI;
constexpr int steps_per_orbit = 60;

/// The monitor of all three: |q|^(3/2).
const avi::Gamma monitor{0.75};

/// Fictive time of an orbit, the integral of dt / g = sqrt(1 - e cos E)^-1 dE, by the trapezium rule.
double fictive_period() {
  constexpr int points = 4096;
  double sum = 0.0;
  for (int k = 0; k < points; ++k)
    sum += 1.0 / std::sqrt(1.0 - eccentricity * std::cos(2.0 * M_PI * k / points));
  return sum * 2.0 * M_PI / points;
}

/// The largest energy error so far, relative to the energy, at ten times in each decade of periods.
class Record {
 public:
  Record(Table& table, std::string method, std::string monitor_name, double last)
      : table_(table), method_(std::move(method)), monitor_(std::move(monitor_name)), last_(last) {}

  /// After each step; false at the end.
  bool operator()(const State2& z) {
    worst_ = std::max(worst_, std::abs(avi::Kepler()(z.q, z.p) / energy_ - 1.0));
    if (z.t >= next_ * period) {
      table_.row(method_, monitor_, next_, worst_);
      if (next_ >= last_) return false;
      while (next_ * period <= z.t && next_ < last_)
        next_ = std::min(last_, next_ * std::pow(10.0, 0.1));
    }
    return true;
  }

 private:
  Table& table_;
  std::string method_, monitor_;
  double energy_ = -0.5, last_, next_ = 1.0, worst_ = 0.0;
};

/// Steps of the method of order 4 for a transformed problem, of a length that may depend on where it is.
void run_steps(const auto& problem, Record record, auto length) {
  State2 z = avi::Kepler::pericentre(eccentricity);
  auto method = avi::collocation<6>(problem, 4);
  do {
    if (method.step(z, length(z)).outcome != avi::Outcome::ok)
      throw std::runtime_error("A step was not solved.");
  } while (record(z));
}

/// Steps for which two methods, of order 4 and 6, agree to the tolerance. Returns the number of steps.
long controlled(double tolerance, auto&& look) {
  State2 z = avi::Kepler::pericentre(eccentricity);
  auto method = avi::collocation<6>(avi::poincare(avi::Kepler(), z), 4);
  auto better = avi::collocation<6>(avi::poincare(avi::Kepler(), z), 6);
  double h = 1e-3;
  for (long steps = 0;;) {
    State2 a = z, b = z;
    const bool solved =
        method.step(a, h).outcome == avi::Outcome::ok && better.step(b, h).outcome == avi::Outcome::ok;
    const double error = solved ? std::sqrt((a.q - b.q).squaredNorm() + (a.p - b.p).squaredNorm()) : 1e300;
    h *= std::clamp(0.9 * std::pow(tolerance / error, 0.2), 0.2, 4.0);
    if (h < 1e-12) throw std::runtime_error("The error cannot be kept to its tolerance.");
    if (!(error <= tolerance)) continue;
    z = a;
    ++steps;
    if (!look(z)) return steps;
  }
}

/// The tolerance with which ten orbits take as many steps as the others.
double equal_work() {
  double low = 1e-12, high = 1e-2;
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    const long steps = controlled(middle, [](const State2& z) { return z.t < 10.0 * period; });
    (steps > 10 * steps_per_orbit ? low : high) = middle;
  }
  return high;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  const long periods = frame.quick ? 1000 : 10'000;
  Table& table = frame.table({"method", "monitor", "periods", "energy_error"});
  const double h = fictive_period() / steps_per_orbit, last = static_cast<double>(periods);
  const State2 start = avi::Kepler::pericentre(eccentricity);
  run_steps(avi::poincare(avi::Kepler(), start, monitor), Record(table, "collocation", "r^1.5", last),
            [h](const State2&) { return h; });
  run_steps(avi::poincare(avi::Kepler(), start), Record(table, "naive", "r^1.5", last),
            [h](const State2& z) { return h * monitor(z.q); });
  const double tolerance = equal_work();
  Record record(table, "error_controlled", "none", last);
  const long steps = controlled(tolerance, [&](const State2& z) { return record(z); });
  fmt::print("{} steps an orbit; the error-controlled run takes {:.1f} with the tolerance {:.2e}.\n",
             steps_per_orbit, steps / last, tolerance);
}
