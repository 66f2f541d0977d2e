#include "optimisers/optimiser_arena/meter.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>

#ifdef AVI_LBFGS
#include <lbfgs.h>
#endif

#include <memory>

namespace arena {
namespace {

/// A meter as the libraries' callbacks see it: through arrays, with vectors that no call allocates.
struct Arrays {
  explicit Arrays(Meter& of) : meter(of), x(of.x0.size()), g(of.x0.size()) {}
  double value(const double* at) {
    x = Eigen::Map<const VectorX>(at, x.size());
    return meter.value(x);
  }
  double both(const double* at, double* gradient) {
    x = Eigen::Map<const VectorX>(at, x.size());
    const double f = meter(x, g);
    Eigen::Map<VectorX>(gradient, g.size()) = g;
    return f;
  }
  Meter& meter;
  VectorX x, g;
};

double value_of(const gsl_vector* x, void* arrays) { return static_cast<Arrays*>(arrays)->value(x->data); }
void both_of(const gsl_vector* x, void* arrays, double* value, gsl_vector* gradient) {
  *value = static_cast<Arrays*>(arrays)->both(x->data, gradient->data);
}
void gradient_of(const gsl_vector* x, void* arrays, gsl_vector* gradient) {
  static_cast<Arrays*>(arrays)->both(x->data, gradient->data);
}

/// With the line tolerance that the manual advises (0.1) and our length of the first step; restarted where it
/// reports that no progress is made, as the manual says, as long as that moves it.
void with_gsl(Meter& meter, const gsl_multimin_fdfminimizer_type* type) {
  meter.throws = false;
  gsl_set_error_handler_off();
  const std::size_t n = static_cast<std::size_t>(meter.x0.size());
  Arrays arrays(meter);
  gsl_multimin_function_fdf f{.f = value_of, .df = gradient_of, .fdf = both_of, .n = n, .params = &arrays};
  const std::unique_ptr<gsl_multimin_fdfminimizer, void (*)(gsl_multimin_fdfminimizer*)> minimiser(
      gsl_multimin_fdfminimizer_alloc(type, n), gsl_multimin_fdfminimizer_free);
  VectorX start = meter.x0;
  const gsl_vector_view x0 = gsl_vector_view_array(start.data(), n);
  const double size = avi::norm(start);
  if (gsl_multimin_fdfminimizer_set(minimiser.get(), &f, &x0.vector, size > 0.0 ? 0.01 * size : 0.01, 0.1) !=
      GSL_SUCCESS)
    return;
  for (int stuck = 0; !meter.over && stuck < 3;) {
    const long before = meter.iterations;
    if (gsl_multimin_fdfminimizer_iterate(minimiser.get()) == GSL_SUCCESS)
      meter.iterations = before + 1, stuck = 0;
    else if (++stuck, gsl_multimin_fdfminimizer_restart(minimiser.get()) != GSL_SUCCESS)
      return;
  }
}

#ifdef AVI_LBFGS
/// Ten pairs; every other parameter as the library has it, its own stopping tests off.
void with_lbfgs(Meter& meter) {
  meter.throws = false;
  lbfgs_parameter_t parameters;
  lbfgs_parameter_init(&parameters);
  parameters.m = 10;
  parameters.epsilon = 0.0;
  const int n = static_cast<int>(meter.x0.size());
  const std::unique_ptr<double, void (*)(double*)> x(lbfgs_malloc(n), lbfgs_free);
  Eigen::Map<VectorX>(x.get(), n) = meter.x0;
  Arrays arrays(meter);
  lbfgs(
      n, x.get(), nullptr,
      [](void* of, const double* at, double* gradient, int, double) {
        return static_cast<Arrays*>(of)->both(at, gradient);
      },
      [](void* of, const double*, const double*, double, double, double, double, int, int k, int) {
        static_cast<Arrays*>(of)->meter.iterations = k;
        return static_cast<Arrays*>(of)->meter.over ? 1 : 0;
      },
      &arrays, &parameters);
}
#endif

}  // namespace

std::vector<Method> library_methods() {
  std::vector<Method> all;
  for (const auto& [name, type] : {std::pair{"gsl_conjugate_fr", gsl_multimin_fdfminimizer_conjugate_fr},
                                   {"gsl_conjugate_pr", gsl_multimin_fdfminimizer_conjugate_pr},
                                   {"gsl_bfgs2", gsl_multimin_fdfminimizer_vector_bfgs2}})
    all.push_back({name, {[type = type](Meter& meter) { with_gsl(meter, type); }}});
#ifdef AVI_LBFGS
  all.push_back({"lbfgs", {with_lbfgs}});
#endif
  return all;
}

}  // namespace arena
