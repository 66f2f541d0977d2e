#pragma once
#include "order/order.hpp"

#include "avi/adaptive/monitors.hpp"
#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/pendulum.hpp"

#include <algorithm>
#include <cmath>
#include <span>

/// @file
/// The grid for one construction. The Taylor order is chosen at run time, so each problem and type compiles
/// once.

namespace experiment {

inline std::vector<avi::Quadrature> order_rules() {
  return {avi::rectangle_left(), avi::midpoint(), avi::trapezoid(), avi::radau(2),
          avi::simpson(),        avi::gauss(2),   avi::radau(3),    avi::boole(),
          avi::gauss(3),         avi::lobatto(4), avi::gauss(4),    avi::lobatto(5),
          avi::radau(5),         avi::gauss(5),   avi::gauss(6),    avi::lobatto(7)};
}

/// Slope of the error at the end of [0, horizon] in fictive time, over steps horizon / N. `error(z)` compares
/// the final state with the exact one at its own physical time.
template <class MakeMethod, class State, class Error>
avi::OrderFit order_of(const MakeMethod& make, const State& start, double horizon, const Error& error) {
  std::vector<double> h, errors;
  for (int n = 2; n <= 1200; n = std::max(n + 1, n * 4 / 3)) {
    auto method = make();
    State z = start;
    const double step = horizon / n;
    const auto run = avi::integrate(method, z, step, {.steps = n});
    h.push_back(step);
    errors.push_back(run.outcome == avi::Outcome::ok ? error(z) : std::nan(""));
    if (errors.back() < 1e-13) break;
  }
  // Steps too long for the asymptotic range may seem to converge faster, after which the filter takes the
  // true slope for a plateau: they are dropped until it leaves enough points.
  const std::span<const double> steps(h), misses(errors);
  avi::OrderFit fit;
  for (std::size_t skip = 0; skip + 3 <= h.size() && fit.points < 3; ++skip)
    fit = avi::fit_order(steps.subspan(skip), misses.subspan(skip),
                         {.floor = 2e-13, .at_least = 3, .at_most = 5});
  return fit;
}

template <avi::Generating type, avi::Construction construction, class Problem, class State, class Error>
void add_cells(std::vector<OrderCell>& cells, const std::string& name, const std::string& construction_name,
               const Problem& problem, const State& start, double horizon, const Error& error, bool quick) {
  const auto rules = order_rules();
  for (int r = 0; r <= (quick ? 3 : 7); ++r)
    for (const auto& rule : rules) {
      const auto fit = order_of([&] { return avi::htvi_of_order<type, construction>(r, problem, rule); },
                                start, horizon, error);
      cells.push_back({name, type == avi::Generating::type2 ? "II" : "III", construction_name, r, rule.name,
                       std::min(r + 1, rule.order), fit.order, fit.points});
    }
}

/// The end of a run without closed form: order 16 and small steps, far below every error that is fitted.
template <class H, class State>
auto against_reference(const H& hamiltonian, const State& start, double horizon) {
  const auto problem = avi::poincare<State::dimension>(hamiltonian, start);
  auto method = avi::htvi_of_order<avi::Generating::type2>(15, problem, avi::gauss(8));
  State exact = start;
  constexpr int steps = 64;
  const auto run = avi::integrate(method, exact, horizon / steps, {.steps = steps});
  if (run.outcome != avi::Outcome::ok) throw std::runtime_error(run.message);
  return [exact](const State& z) { return std::hypot((z.q - exact.q).norm(), (z.p - exact.p).norm()); };
}

template <avi::Construction construction>
std::vector<OrderCell> order_cells(const std::string& name, bool quick,
                                   const std::function<void(double)>& done) {
  std::vector<OrderCell> cells;
  const auto both_types = [&](const std::string& label, const auto& problem, const auto& start,
                              double horizon, const auto& error) {
    add_cells<avi::Generating::type2, construction>(cells, label, name, problem, start, horizon, error,
                                                    quick);
    add_cells<avi::Generating::type3, construction>(cells, label, name, problem, start, horizon, error,
                                                    quick);
  };
  const auto kepler_error = [](const avi::State<2>& z) {
    const auto exact = avi::Kepler::exact(0.3, z.t);
    return std::hypot((z.q - exact.q).norm(), (z.p - exact.p).norm());
  };
  const avi::State<1> swing{.q = avi::Vector<double, 1>(1.2), .p = avi::Vector<double, 1>(0.7)};
  both_types("pendulum", avi::poincare<1>(avi::Pendulum{}, swing), swing, 2.0,
             against_reference(avi::Pendulum{}, swing, 2.0));
  done(0.2);
  const avi::State<2> star{.q = {0.1, -0.3}, .p = {0.4, 0.2}};
  both_types("henon_heiles", avi::poincare<2>(avi::HenonHeiles{}, star), star, 2.5,
             against_reference(avi::HenonHeiles{}, star, 2.5));
  done(0.4);
  const auto orbit = avi::Kepler::pericentre(0.3);
  both_types("kepler", avi::poincare<2>(avi::Kepler{}, orbit), orbit, 1.5, kepler_error);
  done(0.7);
  both_types("kepler_gamma", avi::poincare<2>(avi::Kepler{}, orbit, avi::NormSquared{}), orbit, 2.0,
             kepler_error);
  done(1.0);
  return cells;
}

}  // namespace experiment
