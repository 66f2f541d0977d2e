#include "common/frame.hpp"
#include "common/reference.hpp"
#include "common/timing.hpp"

#include "avi/core/integrate.hpp"
#include "avi/diagnostics/drift.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/problems/kepler.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string>
#include <vector>

// What the number format and the way of adding are worth, for one method (logarithmic Hamiltonian, order 10,
// whose orbits of Kepler's problem are exact up to time): position error in four formats; and energy error,
// which is rounding alone, against the number of steps with compensated and with plain sums. Rounding errors
// that do not favour a sign grow as the square root of the number of steps (Brouwer 1937). Doubles are those
// of the library's own method; since its State holds doubles, the other formats take ExtendedRun, the same
// composition in any format (tests/unit/reference_test.cpp holds one against the other).

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
void positions(experiment::Table& out, const std::string& format, const std::string& name, int periods,
               double finest) {
  for (double h = 1.6; h > finest; h *= 0.8) {
    std::vector<double> errors, seconds;
    for (int k = 0; k < starts; ++k) {
      const auto z = start<Number>(0.9, k, sizeof(Number) == 4 ? 1e-6 : 1e-14);
      seconds.push_back(experiment::seconds(
          [&] { errors.push_back(position_error<Number, summation>(z, h, periods * period)); }));
    }
    out.row(format, name, h, periods, median(errors), experiment::rounded(median(seconds)));
  }
}

/// Largest |H - H_0| / |H_0| up to each of the milestones, in periods.
template <Summation summation>
std::vector<double> energy_errors(double e, int k, const std::vector<int>& milestones) {
  const avi::Kepler kepler;
  avi::State<2> z = start<double>(e, k, 1e-14);
  auto method = library_method<summation>(z);
  const double first = kepler(z.q, z.p);
  std::vector<double> errors;
  double largest = 0.0;
  for (int periods : milestones) {
    const auto run = avi::integrate(method, z, 0.2, {.time = periods * period}, [&](const auto& now, long) {
      largest = std::max(largest, std::abs(kepler(now.q, now.p) / first - 1.0));
    });
    errors.push_back(run.outcome == avi::Outcome::ok ? largest : std::nan(""));
  }
  return errors;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, "precision_study", "What number format and summation are worth", [](Frame& frame) {
    auto formats = frame.table({"format", "summation", "h", "periods", "position_error", "seconds"});
    const int periods = frame.quick ? 3 : 30;
    frame.progress("formats", 0.1);
    positions<float, Summation::plain>(formats, "float", "plain", periods, 0.3);
    positions<float, Summation::compensated>(formats, "float", "compensated", periods, 0.3);
    positions<double, Summation::plain>(formats, "double", "plain", periods, 0.15);
    positions<double, Summation::compensated>(formats, "double", "compensated", periods, 0.15);
    positions<long double, Summation::plain>(formats, "long double", "plain", periods, 0.15);
    auto growth = frame.table({"eccentricity", "summation", "periods", "energy_error"});
    auto fits =
        frame.table({"eccentricity", "summation", "exponent", "standard_error", "predicted", "energy_error"});
    growth.note("energy_error", "median over nine starts of the largest relative error up to then");
    fits.note("exponent", "of the energy error in the number of steps, fitted from 10 periods on");
    const std::vector<int> milestones =
        frame.quick ? std::vector{10, 20, 40} : std::vector{1, 3, 10, 30, 100, 300, 1000};
    for (double e : {0.9, 0.99})
      for (bool compensated : {true, false}) {
        frame.progress("growth", 0.5);
        std::vector<std::vector<double>> runs;
        for (int k = 0; k < starts; ++k)
          runs.push_back(compensated ? energy_errors<Summation::compensated>(e, k, milestones)
                                     : energy_errors<Summation::plain>(e, k, milestones));
        std::vector<double> x, y;
        double last = 0.0;
        for (std::size_t i = 0; i < milestones.size(); ++i) {
          std::vector<double> column;
          for (const auto& each : runs)
            column.push_back(each[i]);
          last = median(column);
          growth.row(e, compensated ? "compensated" : "plain", milestones[i], last);
          if (milestones[i] < 10) continue;
          x.push_back(std::log(milestones[i]));
          y.push_back(std::log(last));
        }
        const auto fit = avi::fit_drift(x, y);
        fits.row(e, compensated ? "compensated" : "plain", fit.slope, fit.standard_error, 0.5, last);
      }
    frame.progress("done", 1.0);
    frame.write(growth, "growth");
    frame.write(fits, "fits");
    frame.write(formats);
  });
}
