#pragma once
#include "avi/core/outcome.hpp"
#include "common/rules/bregman_runge_kutta.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <limits>
#include <memory>

// The adaptive drivers of the GNU Scientific Library as optimisation methods: an independent check of our own
// Runge-Kutta pairs, and of the claims based on them.

namespace experiment {

/// Bregman dynamics with a GSL stepper under its standard step control; an iteration is an accepted step.
struct GslMethod {
  const gsl_odeiv2_step_type* type = gsl_odeiv2_step_rkf45;
  avi::BregmanFamily family;
  double rtol = 1e-3, atol = 1e-6, first_step = 1e-6;
  avi::BregmanStart from{};

  struct State {
    avi::VectorX z;
    BregmanField field;
    double h;
    double tau = 0.0;
    avi::VectorX at = z, rate = z;
    std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver;
  };

  State start(const avi::Iterate& first) const {
    family.validate();
    gsl_set_error_handler_off();
    const avi::VectorX z = bregman_point(first, from);
    const gsl_odeiv2_system system{nullptr, nullptr, static_cast<std::size_t>(z.size()), nullptr};
    return {.z = z,
            .field = {.family = family, .q = first.x, .gradient = first.gradient},
            .h = first_step,
            .driver = {gsl_odeiv2_driver_alloc_y_new(&system, type, first_step, atol, rtol),
                       gsl_odeiv2_driver_free}};
  }

  template <class F>
  avi::Outcome update(State& s, avi::Iterate& now, F& f) const {
    struct Call {
      State* state;
      F* objective;
    } call{&s, &f};
    const auto rhs = [](double, const double z[], double dz[], void* data) -> int {
      auto& [state, objective] = *static_cast<Call*>(data);
      std::copy(z, z + state->z.size(), state->at.data());
      state->field.evaluate(*objective, state->at, state->rate);
      std::copy(state->rate.begin(), state->rate.end(), dz);
      return GSL_SUCCESS;
    };
    const gsl_odeiv2_system system{rhs, nullptr, static_cast<std::size_t>(s.z.size()), &call};
    const double never = std::numeric_limits<double>::max();
    const int status = gsl_odeiv2_evolve_apply(s.driver->e, s.driver->c, s.driver->s, &system, &s.tau, never,
                                               &s.h, s.z.data());
    if (status != GSL_SUCCESS) return avi::Outcome::not_converged;
    now.x = s.z.head(now.x.size());
    now.evaluated = false;
    return avi::Outcome::ok;
  }
};

}  // namespace experiment
