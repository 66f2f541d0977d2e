#include "frame/frame.hpp"
#include "frame/timing.hpp"

#include "avi/adaptive/monitors.hpp"
#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"

#include <algorithm>
#include <cmath>
#include <string>

// What each monitor costs on Kepler's problem at matched energy error: steps per orbit and time per step of
// HTVI4, with the fictive step adapted until the largest energy error over three orbits is the one wanted.

namespace {

using avi::Kepler;
using State = avi::State<2>;

constexpr double orbits = 3.0;
constexpr double horizon = 2.0 * M_PI * orbits;

struct Measured {
  bool ok = false;
  double energy_error = 0.0, position_error = 0.0, shortest = horizon, longest = 0.0;
  long steps = 0, evaluations = 0;
};

template <class G>
auto method_for(double e, const G& monitor) {
  return avi::type2<3, avi::authors>(avi::poincare<2>(Kepler{}, Kepler::pericentre(e), monitor),
                                     avi::simpson());
}

template <class G>
Measured measure(double e, const G& monitor, double h) {
  auto method = method_for(e, monitor);
  State z = Kepler::pericentre(e);
  const double energy = Kepler{}(z.q, z.p);
  Measured m;
  double t = 0.0;
  const auto run =
      avi::integrate(method, z, h, {.time = horizon, .steps = 3'000'000}, [&](const State& s, long) {
        m.energy_error = std::max(m.energy_error, std::abs(Kepler{}(s.q, s.p) - energy));
        m.shortest = std::min(m.shortest, s.t - t);
        m.longest = std::max(m.longest, s.t - t);
        t = s.t;
      });
  m.ok = run.outcome == avi::Outcome::ok;
  m.steps = run.steps;
  m.evaluations = run.evaluations;
  m.position_error = (z.q - Kepler::exact(e, z.t).q).norm();
  return m;
}

/// The fictive step at which the energy error is `target`, by the secant method on logarithms from a step
/// that is far too long; the order is 4, so that a few corrections are enough.
template <class G>
double calibrated(double e, const G& monitor, double target, double h) {
  Measured m = measure(e, monitor, h);
  for (int k = 0; k < 60 && (!m.ok || m.energy_error > 100.0 * target); ++k)
    m = measure(e, monitor, h *= 0.5);
  for (int k = 0; k < 8 && std::abs(std::log(m.energy_error / target)) > 0.02; ++k) {
    h *= std::pow(target / m.energy_error, 0.25);
    m = measure(e, monitor, h);
  }
  return h;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace experiment;
  return run(
      argc, argv, "monitor_costs", "Cost per step and steps per orbit of each monitor at matched accuracy",
      [](Frame& frame) {
        avi::Table out =
            frame.table({"eccentricity", "monitor", "target", "h", "energy_error", "position_error",
                         "steps_per_orbit", "evaluations_per_step", "longest_over_shortest", "seconds"});
        out.note("method", "HTVI4, Type II, r = 3, Simpson's rule, as in Tables 1 and 2");
        out.note("seconds", "per orbit, the least of several runs");
        const std::vector<double> eccentricities =
            frame.quick ? std::vector<double>{0.9} : std::vector<double>{0.9, 0.99};
        const std::vector<double> targets =
            frame.quick ? std::vector<double>{1e-5} : std::vector<double>{1e-5, 1e-7};
        double done = 0.0;
        for (double e : eccentricities)
          for (double target : targets) {
            const auto row = [&](const char* name, const auto& monitor, double first) {
              frame.progress(name, done);
              const double h = calibrated(e, monitor, target, first);
              const Measured m = measure(e, monitor, h);
              const long n = m.steps;
              auto method = method_for(e, monitor);
              const auto least = interleaved_least_seconds({[&] {
                                                             State z = Kepler::pericentre(e);
                                                             avi::integrate(method, z, h, {.steps = n});
                                                           }},
                                                           frame.quick ? 1 : 5);
              out.row(e, name, target, h, m.energy_error, m.position_error, static_cast<double>(n) / orbits,
                      static_cast<double>(m.evaluations) / static_cast<double>(n), m.longest / m.shortest,
                      avi::rounded(least[0] / orbits));
              done += 1.0 / static_cast<double>(7 * eccentricities.size() * targets.size());
            };
            const Kepler kepler;
            row("none", avi::Unit{}, 0.01);
            row("gamma", avi::NormSquared{}, 0.5);
            row("gamma_three_quarters", avi::Gamma{0.75}, 0.5);
            row("arclength", avi::Arclength<Kepler>{kepler, -0.5}, 0.5);
            row("energy", avi::bounded(avi::Energy<Kepler>{kepler, 0.5}, 1e-4, 2.0), 0.5);
            row("truncation_root", avi::TruncationRoot<Kepler>{kepler, 0.5, 1.0}, 0.5);
            row("inverse_lagrangian", avi::bounded(avi::InverseLagrangian<Kepler>{kepler}, 1e-3, 3.0), 0.5);
          }
        frame.progress("done", 1.0);
        frame.write(out);
      });
}
