#include "common/frame.hpp"
#include "common/methods/runge_kutta_4.hpp"

#include "avi/diagnostics/drift.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/n_body.hpp"

#include <cmath>
#include <string>
#include <vector>

// Energy over long runs: Henon-Heiles for a million steps and the figure-eight orbit for a thousand periods.
// A symplectic method shows no drift that a fitted line could tell from zero; a Runge-Kutta method of the
// same order and step does.

namespace {

using namespace experiment;

/// Its gradient makes the model several times faster than derivatives taken automatically.
struct Galaxy : avi::HenonHeiles {
  template <class S>
  avi::Vector<S, 2> d_dq(const avi::Vector<S, 2>& q, const avi::Vector<S, 2>&) const {
    return potential_gradient(q);
  }
  template <class S>
  avi::Vector<S, 2> d_dp(const avi::Vector<S, 2>&, const avi::Vector<S, 2>& p) const {
    return p;
  }
};

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, AVI_SHOWS, [](Frame& frame) {
    Table out = frame.table({"problem", "method", "order", "h", "steps", "t_end", "largest_error", "slope",
                             "standard_error", "t_statistic", "drift_over_run"});
    Table curves = frame.table({"problem", "method", "t", "energy_error"});
    constexpr int blocks = 50;
    out.note("slope", "of the energy error over time, least squares through 50 block means");
    out.note("t_statistic", "slope over its standard error: below 2.0 in size, zero lies within 95 %");
    const auto follow = [&](const std::string& problem, const std::string& name, int order, auto method,
                            const auto& hamiltonian, auto z, double h, long steps) {
      frame.progress(problem + " " + name, 0.5);
      const double energy = hamiltonian(z.q, z.p);
      const long every = steps / 1000;  // a sample is the mean over that many steps
      std::vector<double> times, errors;
      double largest = 0.0, sum = 0.0;
      const auto end = avi::integrate(method, z, h, {.steps = steps}, [&](const auto& s, long k) {
        const double error = (hamiltonian(s.q, s.p) - energy) / std::abs(energy);
        largest = std::max(largest, std::abs(error));
        sum += error;
        if (k % every != 0) return;
        times.push_back(s.t);
        errors.push_back(sum / every);
        sum = 0.0;
      });
      if (end.outcome != avi::Outcome::ok) throw std::runtime_error(end.message);
      const auto fit = avi::fit_drift(times, errors, blocks);
      out.row(problem, name, order, h, end.steps, z.t, largest, fit.slope, fit.standard_error,
              fit.t_statistic, fit.slope * z.t);
      for (std::size_t i = 0; i < times.size(); i += 5)
        curves.row(problem, name, times[i], errors[i]);
    };
    out.note("htvi",
             "the stationary construction under a rule of lower order than its own: r = 3 with Simpson's "
             "rule on Henon and Heiles' problem, r = 5 with three Gauss nodes on the figure eight");
    const long share = frame.quick ? 20 : 1;
    const Galaxy galaxy;
    for (const auto& [name, energy, y] :
         {std::tuple{"henon_heiles_regular", 1.0 / 12.0, 0.2}, {"henon_heiles_chaotic", 1.0 / 8.0, -0.2}}) {
      const auto star = avi::HenonHeiles::on_section(energy, y, 0.0);
      follow(name, "htvi", 4, avi::type2<3>(avi::poincare<2>(galaxy, star), avi::simpson()), galaxy, star,
             0.2, 1'000'000 / share);
      follow(name, "runge_kutta_4", 4, RungeKutta4<2, Galaxy>(galaxy), galaxy, star, 0.2, 1'000'000 / share);
    }
    const auto bodies = avi::FigureEight::problem();
    const auto eight = avi::FigureEight::start();
    // 60 golden ratios, as far from a whole number of steps per period as can be; with one, sampling repeats
    // itself, the line has hardly any scatter, and what is seen is rounding: 1e-17 per step, its sign and
    // size those of the solver's tolerance.
    const double h = avi::FigureEight::period / 97.08203932499369, whole = avi::FigureEight::period / 100.0;
    const auto orbit = avi::type2<5>(avi::poincare<6>(bodies, eight), avi::gauss(3));
    follow("figure_eight", "htvi", 6, orbit, bodies, eight, h, 100'000 / share);
    follow("figure_eight", "htvi_100_steps_per_period", 6, orbit, bodies, eight, whole, 100'000 / share);
    follow("figure_eight", "runge_kutta_4", 4, RungeKutta4<6, avi::NBody<3>>(bodies), bodies, eight, h,
           100'000 / share);
    frame.write(curves, "curves");
    frame.write(out);
  });
}
