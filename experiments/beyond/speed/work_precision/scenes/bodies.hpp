#pragma once
#include "avi/problems/n_body.hpp"

// Bodies of unit mass, whose velocities equal their momenta.

namespace experiment::work_precision {

template <int bodies>
struct UnitBodies : private avi::NBody<bodies> {
  using Base = avi::NBody<bodies>;
  using Base::dimension, Base::kinetic, Base::potential, Base::potential_gradient, Base::d_dq,
      Base::operator();
  UnitBodies() : Base(Base::Masses::Ones()) {}

  template <class V>
  V d_dp(const V&, const V& p) const {
    return p;
  }
};

/// Start of seven bodies, with encounters down to a hundredth of the size of the cluster.
inline avi::State<14> star_cluster_start() {
  avi::State<14> z;
  z.q << 1.0, 0.1, -0.9, 0.4, 0.2, -0.8, -0.3, 0.9, 0.5, 0.6, -0.6, -0.5, 0.1, 0.15;
  z.p << -0.3, 0.9, 0.2, -0.8, 0.9, 0.1, -0.7, -0.4, -0.5, 0.6, 0.5, -0.7, -0.1, 0.3;
  return z;
}

}  // namespace experiment::work_precision
