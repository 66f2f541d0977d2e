#include "common/frame.hpp"
#include "common/power_law.hpp"
#include "common/reference.hpp"
#include "common/timing.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <string>
#include <vector>

// What the number format and the way of adding are worth, for one method (logarithmic Hamiltonian, order 10,
// whose orbits of Kepler's problem are exact up to time): position error in four formats; and energy error,
// which is rounding alone, against the number of steps with compensated and with plain sums, and of
// collocation, whose sums are compensated. Rounding errors that do not favour a sign grow as the square root
// of the number of steps (Brouwer 1937). Doubles are the library's own method; since its State holds doubles,
// the other formats take ExtendedRun, the same composition in any format (tests/unit/reference_test.cpp holds
// one against the other).

namespace {

using namespace experiment;
using avi::Summation;

constexpr int starts = 9;
constexpr double period = 2.0 * M_PI;

/// The start and its neighbours, moved by multiples of `distance`; as double as they are in `Number`.
template <class Number>
avi::State<2> start(double e, int k, double distance) {
  avi::State<2> z = avi::Kepler::pericentre(e);
  z.q[0] += (k - starts / 2) * distance;
  for (auto* v : {&z.q, &z.p})
    for (int i : {0, 1})
      (*v)[i] = static_cast<double>(static_cast<Number>((*v)[i]));
  return z;
}

template <Summation summation>
auto library_method(const avi::State<2>& z) {
  return avi::splitting<summation>(avi::LogHamiltonian(avi::Kepler{}, z),
                                   avi::compositions::sofroniou_spaletta10);
}

/// Error of the position after a run.
template <class Number, Summation summation>
double position_error(const avi::State<2>& start, double h, double time) {
  if constexpr (std::same_as<Number, double>) {
    auto method = library_method<summation>(start);
    avi::State<2> z = start;
    if (avi::integrate(method, z, h, {.time = time}).outcome != avi::Outcome::ok) return std::nan("");
    return (z.q - work_precision::exact_kepler(start, z.t)).norm();
  } else {
    work_precision::ExtendedRun<avi::Kepler, Number, summation> run({}, start, true, static_cast<Number>(h));
    run.run_to(time);
    return (run.position() - work_precision::exact_kepler(start, run.time())).norm();
  }
}

template <class Number, Summation summation>
void positions(Table& out, const std::string& format, const std::string& name, int periods, double finest) {
  for (double h = 1.6; h > finest; h *= 0.8) {
    std::vector<double> errors, seconds;
    for (int k = 0; k < starts; ++k) {
      const auto z = start<Number>(0.9, k, sizeof(Number) == 4 ? 1e-6 : 1e-14);
      seconds.push_back(experiment::seconds(
          [&] { errors.push_back(position_error<Number, summation>(z, h, periods * period)); }));
    }
    out.row(format, name, h, periods, median(errors), rounded(median(seconds)));
  }
}

/// Largest |H - H_0| / |H_0| up to each of the milestones, in periods: of all states, and of those beyond the
/// mean distance. What collocation keeps is g (H + p^t): at the pericentre an energy error is as many times
/// that of the apocentre as g is smaller there.
struct EnergyErrors {
  std::vector<double> all, far;
};

template <class Method>
EnergyErrors energy_errors(Method method, avi::State<2> z, double h, const std::vector<int>& milestones) {
  const avi::Kepler kepler;
  const double first = kepler(z.q, z.p);
  EnergyErrors errors;
  double all = 0.0, far = 0.0;
  for (int periods : milestones) {
    const auto run = avi::integrate(method, z, h, {.time = periods * period}, [&](const auto& now, long) {
      const double error = std::abs(kepler(now.q, now.p) / first - 1.0);
      all = std::max(all, error);
      if (now.q.norm() > 1.0) far = std::max(far, error);
    });
    errors.all.push_back(run.outcome == avi::Outcome::ok ? all : std::nan(""));
    errors.far.push_back(run.outcome == avi::Outcome::ok ? far : std::nan(""));
  }
  return errors;
}

using Run = std::function<EnergyErrors(const avi::State<2>& start, const std::vector<int>& milestones)>;

template <Summation summation>
EnergyErrors of_logarithmic(const avi::State<2>& start, const std::vector<int>& milestones) {
  return energy_errors(library_method<summation>(start), start, 0.2, milestones);
}
EnergyErrors of_collocation(const avi::State<2>& start, const std::vector<int>& milestones) {
  return energy_errors(avi::collocation(avi::poincare(avi::Kepler{}, start, avi::Gamma{0.75}), 16), start,
                       0.7, milestones);
}

}  // namespace

int main(int argc, char** argv) {
  bool extremes = false;
  const auto options = [&](CLI::App& app) {
    add_flag(app, "--extremes", extremes, "A million periods of collocation, some four minutes");
  };
  return run(argc, argv, AVI_SHOWS, options, [&](Frame& frame) {
    auto formats = frame.table({"format", "summation", "h", "periods", "position_error", "seconds"});
    const int periods = frame.quick ? 3 : 30;
    frame.progress("formats", 0.1);
    positions<float, Summation::plain>(formats, "float", "plain", periods, 0.3);
    positions<float, Summation::compensated>(formats, "float", "compensated", periods, 0.3);
    positions<double, Summation::plain>(formats, "double", "plain", periods, 0.15);
    positions<double, Summation::compensated>(formats, "double", "compensated", periods, 0.15);
    positions<long double, Summation::plain>(formats, "long double", "plain", periods, 0.15);
    auto growth =
        frame.table({"eccentricity", "summation", "periods", "energy_error", "method", "energy_error_far"});
    auto fits =
        frame.table({"eccentricity", "summation", "exponent", "standard_error", "predicted", "energy_error",
                     "method", "exponent_far", "standard_error_far", "energy_error_far"});
    growth.note("energy_error", "median over nine starts of the largest relative error up to then");
    growth.note("energy_error_far", "the same of states beyond the mean distance");
    fits.note("exponent", "of the energy error in the number of steps, fitted from 10 periods on");
    const auto study = [&](const char* method, const char* summation, double e, const Run& run,
                           const std::vector<int>& milestones) {
      frame.progress("growth", 0.5);
      std::vector<EnergyErrors> runs;
      for (int k = 0; k < starts; ++k)
        runs.push_back(run(start<double>(e, k, 1e-14), milestones));
      std::vector<double> x, all, far;
      for (std::size_t i = 0; i < milestones.size(); ++i) {
        std::vector<double> of_all, of_far;
        for (const auto& each : runs) {
          of_all.push_back(each.all[i]);
          of_far.push_back(each.far[i]);
        }
        growth.row(e, summation, milestones[i], median(of_all), method, median(of_far));
        if (milestones[i] < 10) continue;
        x.push_back(milestones[i]);
        all.push_back(median(of_all));
        far.push_back(median(of_far));
      }
      const auto fit = power_law(x, all), fit_far = power_law(x, far);
      fits.row(e, summation, fit.slope, fit.standard_error, 0.5, all.back(), method, fit_far.slope,
               fit_far.standard_error, far.back());
    };
    const std::vector<int> milestones =
        frame.quick ? std::vector{10, 20, 40} : std::vector{1, 3, 10, 30, 100, 300, 1000};
    for (double e : {0.9, 0.99}) {
      const char* logarithmic = "log_hamiltonian_sofroniou_spaletta10";
      study(logarithmic, "compensated", e, of_logarithmic<Summation::compensated>, milestones);
      study(logarithmic, "plain", e, of_logarithmic<Summation::plain>, milestones);
      std::vector<int> more{10, 32, 100, 320, 1000};
      if (!frame.quick && e == 0.9) more.insert(more.end(), {3200, 10000});
      if (extremes && e == 0.9) more.insert(more.end(), {32000, 100'000, 320'000, 1'000'000});
      study("collocation16", "compensated", e, of_collocation, more);
    }
    frame.write(growth, "growth");
    frame.write(fits, "fits");
    frame.write(formats);
  });
}
