#include "optimisers/optimiser_arena/meter.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>

#ifdef AVI_LBFGS
#include <lbfgs.h>
#endif

#include <memory>

namespace arena {

namespace {

VectorX copied(const double* x, Eigen::Index n) { return Eigen::Map<const VectorX>(x, n); }

double value_of(const gsl_vector* x, void* meter) {
  return static_cast<Meter*>(meter)->value(copied(x->data, static_cast<Eigen::Index>(x->size)));
}
void both_of(const gsl_vector* x, void* meter, double* value, gsl_vector* gradient) {
  VectorX g;
  *value = (*static_cast<Meter*>(meter))(copied(x->data, static_cast<Eigen::Index>(x->size)), g);
  Eigen::Map<VectorX>(gradient->data, g.size()) = g;
}
void gradient_of(const gsl_vector* x, void* meter, gsl_vector* gradient) {
  double unused;
  both_of(x, meter, &unused, gradient);
}

/// With the line tolerance that the manual advises (0.1) and our length of the first step; restarted where it
/// reports that no progress is made, as the manual says, as long as that moves it.
void with_gsl(Meter& meter, const gsl_multimin_fdfminimizer_type* type) {
  meter.throws = false;
  gsl_set_error_handler_off();
  const std::size_t n = static_cast<std::size_t>(meter.x0.size());
  gsl_multimin_function_fdf f{.f = value_of, .df = gradient_of, .fdf = both_of, .n = n, .params = &meter};
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
  lbfgs(
      n, x.get(), nullptr,
      [](void* of, const double* at, double* gradient, int size, double) {
        VectorX g;
        const double value = (*static_cast<Meter*>(of))(copied(at, size), g);
        Eigen::Map<VectorX>(gradient, size) = g;
        return value;
      },
      [](void* of, const double*, const double*, double, double, double, double, int, int k, int) {
        static_cast<Meter*>(of)->iterations = k;
        return static_cast<Meter*>(of)->over ? 1 : 0;
      },
      &meter, &parameters);
}
#endif

}  // namespace

std::vector<Method> library_methods() {
  std::vector<Method> all{
      {.name = "gsl_conjugate_fr",
       .run = [](Meter& m) { with_gsl(m, gsl_multimin_fdfminimizer_conjugate_fr); }},
      {.name = "gsl_conjugate_pr",
       .run = [](Meter& m) { with_gsl(m, gsl_multimin_fdfminimizer_conjugate_pr); }},
      {.name = "gsl_bfgs2", .run = [](Meter& m) { with_gsl(m, gsl_multimin_fdfminimizer_vector_bfgs2); }}};
#ifdef AVI_LBFGS
  all.push_back({.name = "lbfgs", .run = with_lbfgs});
#endif
  return all;
}

}  // namespace arena
