#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/core/integrate.hpp"
#include "avi/core/state.hpp"
#include "avi/integrators/runge_kutta.hpp"

// A method that is not symplectic, for comparison.

namespace experiment {

/// The classical Runge-Kutta method for Hamilton's equations of H.
template <int n, class H>
class RungeKutta4 {
 public:
  explicit RungeKutta4(const H& hamiltonian) : h_(hamiltonian) {}

  avi::StepReport step(avi::State<n>& z, double h) {
    const auto field = [this](const avi::VectorX& x, avi::VectorX& dx) {
      const avi::Vector<double, n> q = x.head(n), p = x.tail(n);
      dx.head(n) = avi::d_dp(h_, q, p);
      dx.tail(n) = -avi::d_dq(h_, q, p);
    };
    point_ << z.q, z.p;
    field(point_, stages_.k[0]);
    stages_.advance(field, point_, h);
    z.q = stages_.end.head(n);
    z.p = stages_.end.tail(n);
    z.t += h;
    return {.evaluations = 4};
  }

 private:
  H h_;
  avi::VectorX point_ = avi::VectorX::Zero(2 * n);
  avi::RungeKuttaStages<avi::ClassicalRungeKutta> stages_{2 * n};
};

}  // namespace experiment
