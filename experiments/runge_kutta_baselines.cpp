#include "accelerated/curve.hpp"
#include "accelerated/gsl_method.hpp"
#include "accelerated/setting.hpp"
#include "frame/frame.hpp"
#include "frame/timing.hpp"

#include "avi/bregman/runge_kutta.hpp"

// The non-symplectic baselines at p = 10, p_ring = 0.5: the classical Runge-Kutta method over fixed steps,
// embedded pairs over tolerances, ours and GSL's, beside HTVI at its published steps.

namespace {

using namespace experiment;

const std::vector<std::string> columns{
    "method",    "approach", "p",      "p_ring", "rtol", "atol", "h", "iterations", "gradient_evaluations",
    "converged", "outcome",  "seconds"};

class Baselines {
 public:
  explicit Baselines(const Frame& frame)
      : frame_(frame), table_(frame.table(columns)), curves_(curve_table()) {
    table_.note("delta", stopping_.delta);
    table_.note("rtol, atol", "nan where the step is fixed; then h is the step");
    curves_.note("rows", "f at the end of each bin of iterations, its least and largest value in the bin, "
                         "its largest from there on");
  }

  /// Runs a method; the curve is kept when it has a label.
  void add(const std::string& name, const avi::BregmanFamily& family, const auto& method, double rtol,
           double h, const std::string& label = "") {
    const bool direct = family.is_direct();
    frame_.progress(name, done_ += 1.0 / 52.0);
    avi::Minimisation result;
    Curve curve(1.0, 0.01);
    const double time = seconds([&] { result = avi::minimise(f_, method, f_.start(), stopping_, curve); });
    const double nan = std::nan("");
    table_.row(name, direct ? "direct" : "adaptive", family.p, direct ? nan : family.p_ring, rtol,
               std::isnan(rtol) ? nan : atol, h, result.iterations, result.gradient_evaluations,
               result.converged(), avi::name(result.outcome), avi::rounded(time));
    if (!label.empty()) curve.append(curves_, {label, name, direct ? "direct" : "adaptive"});
  }

  void write() const {
    frame_.progress("done", 1.0);
    frame_.write(curves_, "curves");
    frame_.write(table_);
  }

  static constexpr double atol = 1e-6;  // the default of MATLAB's solvers

 private:
  [[nodiscard]] avi::Table curve_table() const {
    std::vector<std::string> names{"curve", "method", "approach"};
    for (auto& column : Curve::columns())
      names.push_back(column);
    return frame_.table(names);
  }

  const Frame& frame_;
  const avi::CorrelatedQuartic f_;
  const avi::Stopping stopping_{.delta = 1e-10, .iterations = 400'000};
  avi::Table table_, curves_;
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
                 all.add("htvi", family, avi::BregmanHtvi{.family = family, .h = published}, nan, published,
                         "htvi " + approach);
                 for (double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
                   const double h = factor * published;
                   all.add("runge_kutta_4", family,
                           avi::BregmanRungeKutta<avi::ClassicalRungeKutta>{.family = family, .h = h}, nan, h,
                           factor == 1.0 ? "runge_kutta_4 " + approach : "");
                 }
                 for (double rtol : tolerances) {
                   const avi::StepControl control{.rtol = rtol, .atol = Baselines::atol};
                   const bool shown = rtol == 1e-3;  // the default of MATLAB's solvers
                   all.add("dormand_prince", family,
                           avi::BregmanEmbedded<avi::DormandPrince>{.family = family, .control = control},
                           rtol, nan, shown ? "dormand_prince " + approach : "");
                   all.add("bogacki_shampine", family,
                           avi::BregmanEmbedded<avi::BogackiShampine>{.family = family, .control = control},
                           rtol, nan, shown ? "bogacki_shampine " + approach : "");
                   for (const auto* type : {gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rk8pd})
                     all.add(std::string("gsl_") + type->name, family,
                             GslMethod{.type = type, .family = family, .rtol = rtol, .atol = Baselines::atol},
                             rtol, nan);
                 }
               }
               all.write();
             });
}
