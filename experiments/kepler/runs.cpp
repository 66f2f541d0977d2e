#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "common/methods/printed_htvi.hpp"
#include "kepler/table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace experiment {
namespace {

/// Type II integrators of one Construction, Taylor order r and rule, for every row of a table.
template <int r, class Construction>
std::vector<KeplerRun> runs_of(const HtviName& name, const avi::Quadrature& quadrature,
                               const KeplerTable& table) {
  const auto start = avi::Kepler::pericentre(table.eccentricity);
  const avi::Kepler kepler;
  const double energy = kepler(start.q, start.p);
  std::vector<KeplerRun> runs;
  const auto add = [&](const KeplerRow& row, auto monitor) {
    const auto make = [=](const State2& from) {
      return avi::type2<r, Construction>(avi::poincare<2>(kepler, from, monitor), quadrature);
    };
    runs.push_back({name, row, Method2(kepler, make), table.eccentricity, {.time = table.horizon}});
  };
  for (const KeplerRow& row : table.htvi) {
    if (row.monitor == "gamma")
      add(row, avi::bounded(avi::NormSquared{}, row.a, row.b));
    else if (row.monitor == "energy")
      add(row, avi::bounded(avi::Energy{kepler, -energy}, row.a, row.b));
    else if (row.monitor == "arclength")
      add(row, avi::bounded(avi::Arclength{kepler, energy}, row.a, row.b));
    else
      add(row, avi::Unit{});
  }
  return runs;
}

}  // namespace

std::vector<KeplerRun> htvi4_runs(const std::string& construction, const KeplerTable& table,
                                  const std::string& rule) {
  const HtviName name{"htvi4", construction, 3, rule};
  const auto nodes = rule == "gauss4" ? avi::gauss(4) : avi::simpson();
  if (construction == "authors") return runs_of<3, Authors>(name, nodes, table);
  if (construction == "printed") return runs_of<3, Printed>(name, nodes, table);
  throw std::invalid_argument("Construction '" + construction + "' is neither authors nor printed.");
}

std::vector<KeplerRun> stationary_runs(const KeplerTable& table) {
  std::vector<KeplerRun> all;
  const auto append = [&](std::vector<KeplerRun> runs) { std::ranges::move(runs, std::back_inserter(all)); };
  // The default rule, r + 1 Gauss nodes, first.
  append(runs_of<3, avi::Stationary>({"htvi", "stationary", 3, "gauss4"}, avi::gauss(4), table));
  append(runs_of<3, avi::Stationary>({"htvi", "stationary", 3, "simpson"}, avi::simpson(), table));
  append(runs_of<1, avi::Stationary>({"htvi", "stationary", 1, "gauss2"}, avi::gauss(2), table));
  return all;
}

KeplerResult KeplerRun::measure() const {
  KeplerResult result;
  State2 before_last, previous = avi::Kepler::pericentre(eccentricity);
  const double start_energy = runner.energy(previous);
  const avi::Run run = observe([&](const State2& s) {
    result.min_step = std::min(result.min_step, s.t - previous.t);
    result.max_step = std::max(result.max_step, s.t - previous.t);
    result.energy_error = std::max(result.energy_error, std::abs(runner.energy(s) - start_energy));
    before_last = previous;
    previous = s;
  });
  result.steps = run.steps;
  result.evaluations = run.evaluations;
  const State2 exact = avi::Kepler::exact(eccentricity, previous.t);
  result.global_error = (previous.q - exact.q).norm();
  result.global_error_shifted = (before_last.q - exact.q).norm();
  if (run.outcome != avi::Outcome::ok)
    result.energy_error = result.global_error = result.global_error_shifted = HUGE_VAL;
  return result;
}

avi::Run KeplerRun::observe(const std::function<void(const State2&)>& observer) const {
  State2 z = avi::Kepler::pericentre(eccentricity);
  avi::AnyMethod<2> method = runner.make(z);
  return avi::integrate(method, z, row.h, until, [&](const State2& s, long) { observer(s); });
}

void KeplerRun::run() const {
  State2 z = avi::Kepler::pericentre(eccentricity);
  avi::AnyMethod<2> method = runner.make(z);
  const avi::Run run = avi::integrate(method, z, row.h, until);
  if (run.outcome != avi::Outcome::ok) throw std::runtime_error(run.message);
}

}  // namespace experiment
