#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"
#include "common/frame.hpp"
#include "common/power_law.hpp"
#include "common/timing.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

// Rounding errors over very many orbits: the energy errors of sixteen orbits at each milestone, and the cost
// of an orbit. If the error of each step is random and unbiased, their root mean square grows as the square
// root of time (Brouwer 1937).

namespace {

using namespace experiment;
using State2 = avi::State<2>;

constexpr int starts = 16;
constexpr double period = 2.0 * M_PI;

/// A random walk with bias, sqrt(random^2 t + bias^2 t^2) with t in periods. It is fitted to the squares y^2
/// by least squares of the relative deviation.
struct Walk {
  double random, bias;
};
Walk walk(const std::vector<double>& t, const std::vector<double>& y) {
  double aa = 0.0, ab = 0.0, bb = 0.0, a1 = 0.0, b1 = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double a = t[i] / (y[i] * y[i]), b = a * t[i];
    aa += a * a, ab += a * b, bb += b * b, a1 += a, b1 += b;
  }
  const double determinant = aa * bb - ab * ab;
  const auto root = [&](double square) { return square > 0.0 ? std::sqrt(square) : 0.0; };
  return {root((a1 * bb - b1 * ab) / determinant), root((aa * b1 - ab * a1) / determinant)};
}

/// Starts with eccentricities near 0.9: sixteen orbits with independent rounding errors.
State2 start(int k) { return avi::Kepler::pericentre(0.9 + 1e-4 * (k - 7.5)); }

/// Errors H / H_0 - 1 after each milestone, in periods, at the first state beyond the mean distance. There
/// the monitor is large, and the energy is what the method preserves.
using Errors = std::vector<double>;
using Run = std::function<Errors(const State2&, const std::vector<long>&)>;

bool arrived(const State2& z, long periods) { return z.t >= periods * period && z.q.squaredNorm() > 1.0; }

Run fixed(double h, auto make) {
  return [=](const State2& from, const std::vector<long>& milestones) {
    auto method = make(from);
    const double first = avi::Kepler()(from.q, from.p);
    State2 z = from;
    Errors errors;
    for (const long mark : milestones) {
      const auto run = avi::integrate(method, z, h, {.time = (mark + 2) * period},
                                      [&](const State2& now, long) { return !arrived(now, mark); });
      if (run.outcome != avi::Outcome::stopped) throw std::runtime_error("A run ended early: " + run.message);
      errors.push_back(avi::Kepler()(z.q, z.p) / first - 1.0);
    }
    return errors;
  };
}

int field(double, const double y[], double f[], void*) {
  const double r2 = y[0] * y[0] + y[1] * y[1], by = -1.0 / (r2 * std::sqrt(r2));
  f[0] = y[2], f[1] = y[3], f[2] = by * y[0], f[3] = by * y[1];
  return GSL_SUCCESS;
}

/// A non-symplectic method from another library: the pair of order 8 of Prince and Dormand, with error
/// control.
Errors of_gsl(const State2& from, const std::vector<long>& milestones) {
  constexpr double tolerance = 1e-13;
  gsl_odeiv2_system system{field, nullptr, 4, nullptr};
  const std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver(
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-4, tolerance, tolerance),
      gsl_odeiv2_driver_free);
  const double first = avi::Kepler()(from.q, from.p);
  State2 z = from;
  double y[4] = {z.q[0], z.q[1], z.p[0], z.p[1]};
  Errors errors;
  for (const long mark : milestones) {
    while (!arrived(z, mark)) {
      if (gsl_odeiv2_evolve_apply(driver->e, driver->c, driver->s, &system, &z.t, (mark + 2) * period,
                                  &driver->h, y) != GSL_SUCCESS)
        throw std::runtime_error("A step of GSL failed.");
      z.q << y[0], y[1];
    }
    z.p << y[2], y[3];
    errors.push_back(avi::Kepler()(z.q, z.p) / first - 1.0);
  }
  return errors;
}

struct Subject {
  const char* method;
  Run run;
  double reach = 1.0;  ///< Part of the horizon that is covered; the slow method shows its behaviour early.
};

std::vector<Subject> subjects() {
  const auto collocation = [](const State2& z) {
    return avi::collocation(avi::poincare(avi::Kepler{}, z, avi::Gamma{0.75}), 16);
  };
  const auto logarithmic = [](const State2& z) {
    return avi::splitting<avi::Summation::compensated>(avi::LogHamiltonian(avi::Kepler{}, z),
                                                       avi::compositions::sofroniou_spaletta10);
  };
  return {{"collocation16", fixed(0.7, collocation)},
          {"log_hamiltonian10", fixed(0.2, logarithmic)},
          {"gsl_rk8pd", of_gsl, 0.1}};
}

}  // namespace

void experiment::conduct(Frame& frame) {
  const long periods = frame.quick ? 1000 : frame.longer ? 1'000'000 : 10'000;
  Table& table = frame.table({"method", "start", "eccentricity", "periods", "energy_error"});
  Table& growth = frame.table("growth", {"method", "periods", "energy_error", "mean"});
  Table& summary =
      frame.table("summary", {"method", "starts", "periods", "energy_error", "exponent", "standard_error",
                              "exponent_before", "exponent_after", "random", "bias", "seconds_per_orbit"});
  table.note("energy_error", "|H / H_0 - 1| of the first state after the milestone beyond the mean distance");
  growth.note("energy_error", "root mean square over the starts");
  growth.note("mean", "mean of H / H_0 - 1 over the starts");
  summary.note("exponent", "power of time of the root mean square, from ten periods on");
  summary.note("exponent_before, exponent_after", "the same up to 562 periods and from there on");
  summary.note("random, bias", "of sqrt(random^2 t + bias^2 t^2), t in periods, fitted from ten periods on");
  double done = 0.0;
  for (const Subject& subject : subjects()) {
    const double last = 1.001 * subject.reach * static_cast<double>(periods);
    std::vector<long> milestones;
    for (double mark = 1.0; mark < last; mark *= std::pow(10.0, 0.25))
      if (milestones.empty() || std::lround(mark) > milestones.back())
        milestones.push_back(std::lround(mark));
    std::vector<double> squares(milestones.size(), 0.0), means(milestones.size(), 0.0), seconds;
    for (int k = 0; k < starts; ++k) {
      frame.progress(subject.method, done++, 3.0 * starts);
      const State2 z = start(k);
      Errors errors;
      seconds.push_back(experiment::seconds([&] { errors = subject.run(z, milestones); }));
      for (std::size_t i = 0; i < errors.size(); ++i) {
        table.row(subject.method, k, 0.9 + 1e-4 * (k - 7.5), milestones[i], std::abs(errors[i]));
        squares[i] += errors[i] * errors[i] / starts;
        means[i] += errors[i] / starts;
      }
    }
    std::vector<double> x, y;
    for (std::size_t i = 0; i < milestones.size(); ++i) {
      growth.row(subject.method, milestones[i], std::sqrt(squares[i]), means[i]);
      if (milestones[i] < 10) continue;
      x.push_back(static_cast<double>(milestones[i]));
      y.push_back(std::sqrt(squares[i]));
    }
    const auto fit = power_law(x, y);
    const auto before = power_law(x, y, [](double t, double) { return t <= 562.0; });
    const auto after = power_law(x, y, [](double t, double) { return t >= 562.0; });
    const Walk fitted = walk(x, y);
    summary.row(subject.method, starts, milestones.back(), y.back(), fit.slope, fit.standard_error,
                before.slope, after.slope, fitted.random, fitted.bias,
                rounded(median(seconds) / static_cast<double>(milestones.back())));
  }
}
