#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"
#include "common/frame.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

// One orbit of Kepler's problem with its steps, by monitor: as many steps of the same method, equal in
// Poincare time.

namespace {

using namespace experiment;
using State2 = avi::State<2>;

constexpr double eccentricity = 0.9, period = 2.0 * M_PI;
constexpr long steps = 36;  ///< Of an orbit.

/// The steps of one orbit of fictive length h: calls look(z) at the start and after each.
void orbit(const auto& monitor, double h, auto look) {
  State2 z = avi::Kepler::pericentre(eccentricity);
  auto method = avi::collocation<8>(avi::poincare(avi::Kepler(), z, monitor), 8);
  look(z);
  const avi::Run run = avi::integrate(method, z, h, {.time = period * (1.0 - 1e-9), .steps = 100'000},
                                      [&](const State2& now, long) { look(now); });
  if (run.outcome != avi::Outcome::ok) throw std::runtime_error(run.message);
}

/// Fictive time of an orbit, the integral of dt / g along it, g = |q|^exponent: by fine steps of |q|^(3/2),
/// each counted with the value of 1 / g in its middle.
double fictive_period(double exponent) {
  const auto monitor = [=](const State2& z) { return std::pow(z.q.norm(), exponent); };
  double sum = 0.0;
  State2 before = avi::Kepler::pericentre(eccentricity);
  orbit(avi::Gamma{0.75}, 0.002, [&](const State2& z) {
    const double rate = 0.5 * (1.0 / monitor(before) + 1.0 / monitor(z));
    sum += (z.t - before.t) * rate;
    before = z;
  });
  return sum;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"monitor", "step", "q_1", "q_2", "t"});
  Table& summary = frame.table("summary", {"monitor", "steps", "h", "energy_error"});
  summary.note("eccentricity", eccentricity);
  const auto add = [&](const char* name, const auto& monitor, double exponent) {
    const double h = fictive_period(exponent) / static_cast<double>(steps);
    double worst = 0.0;
    long step = 0;
    orbit(monitor, h, [&](const State2& z) {
      worst = std::max(worst, std::abs(avi::Kepler()(z.q, z.p) / -0.5 - 1.0));
      table.row(name, step++, z.q[0], z.q[1], z.t);
    });
    summary.row(name, step - 1, h, worst);
  };
  add("none", avi::Unit{}, 0.0);
  add("r", avi::Gamma{0.5}, 1.0);
  add("r^1.5", avi::Gamma{0.75}, 1.5);
  add("r^2", avi::Gamma{1.0}, 2.0);
}
