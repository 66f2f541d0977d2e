#include "beyond/counts/sustained.hpp"
#include "bregman/curve.hpp"
#include "bregman/setting.hpp"
#include "common/frame.hpp"
#include "common/timing.hpp"

// The non-symplectic baselines at p = 10, p_ring = 0.5: the classical Runge-Kutta method over fixed steps,
// embedded pairs over tolerances, ours and GSL's, beside HTVI at its published steps.

namespace {

using namespace experiment;

const std::vector<std::string> columns{
    "method",    "approach", "p",       "p_ring",   "rtol", "atol", "h", "iterations", "gradient_evaluations",
    "converged", "outcome",  "seconds", "sustained"};

class Baselines {
 public:
  explicit Baselines(const Frame& frame)
      : frame_(frame), table_(frame.table(columns)),
        curves_(frame.table(Curve::columns_after({"curve", "method", "approach"}))) {
    table_.note("delta", stopping_.delta);
    table_.note("sustained",
                "first iteration from which the stopping test holds until the run is twice as long");
    table_.note("rtol, atol", "nan where the step is fixed; then h is the step");
    curves_.note("rows", Curve::rows);
  }

  /// Runs a method; the curve is kept when it has a label.
  void add(const std::string& name, const avi::BregmanFamily& family, double rtol, double h,
           const std::string& label = "") {
    const bool direct = family.is_direct();
    const Rule rule{.method = name, .family = family, .h = h, .control = {.rtol = rtol, .atol = atol}};
    frame_.progress(name, done_ += 1.0 / 52.0);
    avi::Minimisation result;
    Curve curve(1.0, 0.01);
    const double time = seconds([&] { result = run_updates(rule, f_, f_.start(), stopping_, curve); });
    const double nan = std::nan("");
    Sustained seen{.cap = 50 * result.iterations};
    if (result.converged()) run_updates(rule, f_, f_.start(), {.delta = 0.0, .iterations = seen.cap}, seen);
    table_.row(name, direct ? "direct" : "adaptive", family.p, direct ? nan : family.p_ring, rtol,
               std::isnan(rtol) ? nan : atol, h, result.iterations, result.gradient_evaluations,
               result.converged(), avi::name(result.outcome), experiment::rounded(time),
               seen.confirmed ? static_cast<double>(seen.sustained()) : nan);
    if (!label.empty()) curve.append(curves_, {label, name, direct ? "direct" : "adaptive"});
  }

  void write() const {
    frame_.progress("done", 1.0);
    frame_.write(curves_, "curves");
    frame_.write(table_);
  }

  static constexpr double atol = 1e-6;  // the default of MATLAB's solvers

 private:
  const Frame& frame_;
  const avi::CorrelatedQuartic f_;
  const avi::Stopping stopping_{.delta = 1e-10, .iterations = 400'000};
  experiment::Table table_, curves_;
  double done_ = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, "runge_kutta_baselines",
             "Runge-Kutta methods on Bregman dynamics, p = 10 and p_ring = 0.5", [](Frame& frame) {
               Baselines all(frame);
               const auto direct = avi::BregmanFamily::direct(10),
                          adaptive = avi::BregmanFamily::adaptive(10, 0.5);
               const double nan = std::nan("");
               const std::vector<double> tolerances = frame.quick
                                                          ? std::vector<double>{1e-2, 1e-3}
                                                          : std::vector<double>{1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
               for (const auto& family : {direct, adaptive}) {
                 const std::string approach = family.is_direct() ? "direct" : "adaptive";
                 const double published = family.is_direct() ? 4e-4 : 1.95e-5;
                 all.add("htvi", family, nan, published, "htvi " + approach);
                 for (double factor : {0.25, 0.5, 1.0, 2.0, 4.0})
                   all.add("runge_kutta_4", family, nan, factor * published,
                           factor == 1.0 ? "runge_kutta_4 " + approach : "");
                 for (double rtol : tolerances) {
                   const bool shown = rtol == 1e-3;  // the default of MATLAB's solvers
                   for (const std::string pair : {"dormand_prince", "bogacki_shampine"})
                     all.add(pair, family, rtol, nan, shown ? pair + " " + approach : "");
                   for (const char* peer : {"gsl_rkf45", "gsl_rk8pd"})
                     all.add(peer, family, rtol, nan);
                 }
               }
               all.write();
             });
}
