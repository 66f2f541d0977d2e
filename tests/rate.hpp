#pragma once
#include <Eigen/Core>

/// A monitor for any dimension, 1/g = 1 + |q|^2.
struct Rate {
  template <class Q>
  auto operator()(const Q& q) const {
    auto sum = 1.0 + q[0] * q[0];
    for (Eigen::Index i = 1; i < q.size(); ++i)
      sum += q[i] * q[i];
    return 1.0 / sum;
  }
};
