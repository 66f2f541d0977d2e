#include "common/rules/rules.hpp"

#include "avi/bregman/bregman_splitting.hpp"
#include "common/rules/bregman_cloning.hpp"
#include "common/rules/gsl_method.hpp"
#include "common/rules/update_rules.hpp"

#include <stdexcept>

namespace experiment {

avi::Minimisation run_updates(const Rule& rule, const AnyObjective& f, const avi::VectorX& x0,
                              const avi::Stopping& stopping, const AnyWitness& witness) {
  const auto run = [&](const auto& method) { return avi::run_updates(f, method, x0, stopping, witness); };
  const auto& [name, family, h, from, clock, control] = rule;
  // clang++ 14 cannot capture a structured binding without an initialiser.
  const auto or_default = [h = h](double otherwise) { return std::isnan(h) ? otherwise : h; };

  if (name == "htvi") return run(avi::BregmanHtvi{.family = family, .h = h, .from = from, .clock = clock});
  if (name == "heavy_ball") return run(avi::BregmanHeavyBall{.family = family, .h = h, .from = from});
  if (name == "splitting") return run(avi::BregmanSplitting{.family = family, .h = h, .from = from});
  using enum CloneComposition;
  for (const auto composition : {strang, yoshida4, yoshida6})
    if (name == clone_name(composition))
      return run(BregmanCloning{.family = family, .h = h, .composition = composition, .from = from});
  if (name == "runge_kutta_4")
    return run(BregmanRungeKutta<avi::ClassicalRungeKutta>{.family = family, .h = h, .from = from});
  if (name == "dormand_prince")
    return run(BregmanEmbedded<avi::DormandPrince>{.family = family, .control = control, .from = from});
  if (name == "bogacki_shampine")
    return run(BregmanEmbedded<avi::BogackiShampine>{.family = family, .control = control, .from = from});
  for (const auto* type : {gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rk8pd})
    if (name == std::string("gsl_") + type->name)
      return run(GslMethod{
          .type = type, .family = family, .rtol = control.rtol, .atol = control.atol, .from = from});

  if (name == "nag") return run(Nag{.h = or_default(Nag{}.h)});
  if (name == "nag_from_1") return run(Nag{.h = or_default(Nag{}.h), .first = 1.0});
  if (name == "gradient_descent") return run(GradientDescent{.h = or_default(GradientDescent{}.h)});
  if (name == "adam") return run(Adam{.rate = or_default(Adam{}.rate)});
  if (name == "adagrad") return run(AdaGrad{.rate = or_default(AdaGrad{}.rate)});
  if (name == "rmsprop") return run(RmsProp{.rate = or_default(RmsProp{}.rate)});
  if (name == "trust_region") return run(TrustRegion{});
  throw std::invalid_argument("Method '" + name + "' is none of those that common/rules/rules.hpp names.");
}

}  // namespace experiment
