#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "common/frame.hpp"
#include "common/methods/methods.hpp"
#include "common/methods/search.hpp"

#include <complex>
#include <optional>

// The largest step of each integrator before it breaks down, compared with the limit of linear theory, and
// how the run with the next larger step ends.

namespace {

using namespace experiment;

/// Spectral radius of the map of one step at the fixed point q = p = 0 of the Henon-Heiles problem, in the
/// plane (x, p_x), where the problem is a linear oscillator of frequency 1. NaN if the step fails.
double spectral_radius(const Method2& run, double h) {
  constexpr double small = 1e-9;  // relative size of the nonlinear terms
  const Limits one{.time = HUGE_VAL, .steps = 1, .energy_error = HUGE_VAL};
  State2 position{.q = {small, 0.0}, .p = {0.0, 0.0}}, momentum{.q = {0.0, 0.0}, .p = {small, 0.0}};
  const Attempt a = attempt(run, position, h, one), b = attempt(run, momentum, h, one);
  if (a.run.steps != 1 || b.run.steps != 1) return std::nan("");
  const double trace = (a.end.q[0] + b.end.p[0]) / small;
  const double determinant = (a.end.q[0] * b.end.p[0] - b.end.q[0] * a.end.p[0]) / (small * small);
  return std::abs(0.5 * std::abs(trace) +
                  std::sqrt(std::complex<double>(0.25 * trace * trace - determinant)));
}

/// The step at which the oscillator first becomes unstable, which is h omega in linear theory, or at which
/// the implicit equations of a step are no longer solved; 20 if neither happens below.
struct LinearLimit {
  double h;
  std::string reason;
};

LinearLimit linear_limit(const Method2& run) {
  const auto stable = [&](double h) { return spectral_radius(run, h) <= 1.0 + 1e-6; };
  double low = 0.05, high = low;
  while (high < 20.0 && stable(high))
    low = high, high *= 1.005;
  if (high >= 20.0) return {20.0, "none"};
  for (int k = 0; k < 30; ++k)
    (stable(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return {low, std::isnan(spectral_radius(run, 1.001 * low)) ? "not_converged" : "unstable"};
}

struct Case {
  std::string method, monitor;
  Method2 on_kepler;
  std::optional<Method2> on_henon_heiles;
};

std::vector<Case> cases(bool quick) {
  const PositionMonitor none{PositionMonitor::none}, adaptive{PositionMonitor::power_of_radius, 1.5};
  std::vector<Case> all;
  for (const char* name : {"stormer_verlet", "yoshida4", "kahan_li8", "runge_kutta_4"})
    all.push_back({name, "none", explicit_on_kepler(name), explicit_on_henon_heiles(name)});
  for (const char* name : {"log_hamiltonian", "adaptive_verlet", "hairer_soderlind"})
    all.push_back(
        {name, name == std::string("log_hamiltonian") ? "1/V" : "r^1.5", explicit_on_kepler(name), {}});
  for (const int order : quick ? std::vector{4, 8} : std::vector{4, 6, 8, 12}) {
    const std::string name = "stationary" + std::to_string(order);
    all.push_back({name, "none", stationary(order, none), stationary_henon_heiles(order)});
    all.push_back({name, "r^1.5", stationary(order, adaptive), {}});
  }
  for (const int order : quick ? std::vector{4, 16} : std::vector{4, 8, 12, 16}) {
    const std::string name = "collocation" + std::to_string(order);
    all.push_back({name, "none", collocation(order, none), collocation_henon_heiles(order)});
    all.push_back({name, "r^1.5", collocation(order, adaptive), {}});
  }
  return all;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"problem", "method", "monitor", "h", "energy_error", "h_linear",
                              "linear_reason", "h_beyond", "beyond", "time_reached"});
  table.note("h",
             "largest step whose energy error stays below the bound: oscillator 1000, others 0.1; T = 300");
  table.note("h_linear",
             "limit of linear theory: oscillator, and Henon-Heiles in units of its frequency 1; Kepler 2 "
             "r^1.5 / g at the pericentre, Stormer-Verlet's limit for the frequency r^-1.5");
  table.note("linear_reason", "unstable: an eigenvalue leaves the unit circle; not_converged: the step is "
                              "not solved; none: neither up to h = 20");
  table.note("beyond", "how the run with h_beyond ends, with the time of its last good state");
  const double e = 0.9;
  const State2 kepler = avi::Kepler::pericentre(e);
  const State2 galaxy = avi::HenonHeiles::on_section(1.0 / 12.0, 0.2, 0.0);
  const State2 oscillator{.q = {1e-6, 0.0}, .p = {0.0, 0.0}};
  const auto all = cases(frame.quick);
  const auto measure = [&](const std::string& problem, const Case& c, const Method2& run, const State2& start,
                           double bound, LinearLimit linear) {
    const Limits limits{.time = 300.0, .steps = 2'000'000, .energy_error = bound};
    const Largest found = largest_step(run, start, problem == "oscillator" ? 16.0 : 8.0, limits, 0.002);
    const bool broke = found.h_beyond > 0.0;
    table.row(problem, c.method, c.monitor, found.h, found.at.energy_error, linear.h, linear.reason,
              found.h_beyond, broke ? found.beyond.ending() : "none", broke ? found.beyond.end.t : unknown);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Case& c = all[i];
    frame.progress(c.method + " " + c.monitor, i, all.size());
    if (c.on_henon_heiles) {
      const LinearLimit limit = linear_limit(*c.on_henon_heiles);
      measure("oscillator", c, *c.on_henon_heiles, oscillator, 1e3, limit);
      measure("henon_heiles", c, *c.on_henon_heiles, galaxy, 0.1, limit);
    }
    measure("kepler", c, c.on_kepler, kepler, 0.1,
            {c.monitor == "none" ? 2.0 * std::pow(1.0 - e, 1.5) : 2.0, "unstable"});
  }
}
