#pragma once
#include "avi/problems/n_body.hpp"

/// @file
/// Bodies of unit mass, whose velocity is their momentum.

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

}  // namespace experiment::work_precision
