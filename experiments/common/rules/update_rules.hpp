#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

// Established update rules for avi::run_updates(): those with which the paper compares, and gradient descent.
// Each has a State, kept between updates; start(), which creates it and throws std::invalid_argument for a
// parameter out of range; and update(), which moves x once.

namespace experiment {

using avi::Outcome, avi::VectorX, avi::require, avi::require_positive, avi::Iterate, avi::norm;

/// Subtracts step(g, i) from each entry i of x, where g is that entry of the known gradient. The loop
/// evaluates at the new x.
Outcome descend(Iterate& now, const auto& step) {
  for (Eigen::Index i = 0; i < now.x.size(); ++i)
    now.x[i] -= step(now.gradient[i], i);
  now.evaluated = false;
  return Outcome::ok;
}

/// Gradient descent (Cauchy 1847): \f$x_k = x_{k-1} - h\, \nabla f(x_{k-1})\f$.
struct GradientDescent {
  double h = 1e-3;  ///< Step size, finite and positive.

  struct State {};  ///< No state is needed.
  State start(const Iterate&) const {
    require_positive("Step size h", h);
    return {};
  }

  Outcome update(State&, Iterate& now, auto&) const {
    return descend(now, [&](double g, Eigen::Index) { return h * g; });
  }
};

/// Nesterov's accelerated gradient method (Nesterov 1983): gradient steps from a point extrapolated along the
/// last displacement. \f[ x_k = y_{k-1} - h\, \nabla f(y_{k-1}), \quad y_k = x_k + \frac{k-1}{k+2}\, (x_k -
/// x_{k-1}). \f] This is equation (4.1) of the paper, which does not give the value of k at the first update.
/// With 1, the usual reading, the first update has no momentum, and the counts differ from the published
/// ones. With 2, that is k/(k+3) at the k-th update, they agree. The gradient is evaluated at y and the
/// stopping test at x: two gradients per iteration, of which the method itself needs one.
struct Nag {
  double h = 1e-3;   ///< Step size, finite and positive.
  double first = 2;  ///< k of the first update, finite and at least 1.

  struct State {
    VectorX y;         ///< y_k.
    VectorX gradient;  ///< Gradient at y_k.
    VectorX previous;  ///< x_{k-1}.
    long k = 0;        ///< Iterations completed.
  };

  State start(const Iterate& begin) const {
    require_positive("Step size h", h);
    require(std::isfinite(first) && first >= 1.0, "NAG's first k", first, "finite and at least 1");
    return {.y = begin.x, .gradient = begin.gradient, .previous = begin.x};
  }

  /// Moves x once; from the second iteration on, this evaluates a gradient at y.
  Outcome update(State& state, Iterate& now, auto& f) const {
    if (state.k > 0) f(state.y, state.gradient);
    state.previous.swap(now.x);
    now.x = state.y - h * state.gradient;
    const double k = first + static_cast<double>(state.k++);
    state.y = now.x + ((k - 1.0) / (k + 2.0)) * (now.x - state.previous);
    now.evaluated = false;
    return Outcome::ok;
  }
};

/// ADAM (Kingma and Ba 2015, Algorithm 1): steps scaled by decaying means of the gradient and its square. For
/// each entry, \f[ m \leftarrow \beta_1 m + (1 - \beta_1)\, g, \quad v \leftarrow \beta_2 v + (1 - \beta_2)\,
/// g^2, \quad x \mathrel{-}= rate\; \frac{m/(1 - \beta_1^k)}{\sqrt{v/(1 - \beta_2^k)} + \epsilon}. \f]
struct Adam {
  double rate = 1e-3;     ///< Step size, positive.
  double beta_1 = 0.9;    ///< Decay of the mean gradient, in [0, 1).
  double beta_2 = 0.999;  ///< Decay of the mean squared gradient, in [0, 1).
  double epsilon = 1e-8;  ///< Added to the root, at least 0.

  struct State {
    VectorX mean;          ///< m.
    VectorX square;        ///< v.
    double power_1 = 1.0;  ///< beta_1^k.
    double power_2 = 1.0;  ///< beta_2^k.
  };

  State start(const Iterate& first) const {
    require_positive("ADAM's rate", rate);
    require(beta_1 >= 0.0 && beta_1 < 1.0, "ADAM's beta_1", beta_1, "in [0, 1)");
    require(beta_2 >= 0.0 && beta_2 < 1.0, "ADAM's beta_2", beta_2, "in [0, 1)");
    require(std::isfinite(epsilon) && epsilon >= 0.0, "ADAM's epsilon", epsilon, "finite and at least 0");
    const VectorX zero = VectorX::Zero(first.x.size());
    return {.mean = zero, .square = zero};
  }

  Outcome update(State& state, Iterate& now, auto&) const {
    state.power_1 *= beta_1;
    state.power_2 *= beta_2;
    const double scale_1 = 1.0 - state.power_1, scale_2 = 1.0 - state.power_2;
    return descend(now, [&](double g, Eigen::Index i) {
      state.mean[i] = beta_1 * state.mean[i] + (1.0 - beta_1) * g;
      state.square[i] = beta_2 * state.square[i] + (1.0 - beta_2) * (g * g);
      return rate * (state.mean[i] / scale_1) / (std::sqrt(state.square[i] / scale_2) + epsilon);
    });
  }
};

/// AdaGrad with a diagonal scaling (Duchi, Hazan and Singer 2011): \f$v \mathrel{+}= g^2\f$, \f$x
/// \mathrel{-}= rate\; g/(\sqrt v + \epsilon)\f$ for each entry, with v = 0 at the start.
struct AdaGrad {
  double rate = 1.0;      ///< Step size, positive.
  double epsilon = 1e-8;  ///< Added to the root, at least 0.

  struct State {
    VectorX square;  ///< v.
  };

  State start(const Iterate& first) const {
    require_positive("AdaGrad's rate", rate);
    require(std::isfinite(epsilon) && epsilon >= 0.0, "AdaGrad's epsilon", epsilon, "finite and at least 0");
    return {.square = VectorX::Zero(first.x.size())};
  }

  Outcome update(State& state, Iterate& now, auto&) const {
    return descend(now, [&](double g, Eigen::Index i) {
      state.square[i] += g * g;
      return rate * g / (std::sqrt(state.square[i]) + epsilon);
    });
  }
};

/// RMSprop (Tieleman and Hinton 2012, lecture 6.5): \f$v \leftarrow \rho v + (1 - \rho)\, g^2\f$, \f$x
/// \mathrel{-}= rate\; g/\sqrt{v + \epsilon}\f$ for each entry.
///
/// \f$\epsilon\f$ is inside the root. Many programs add it outside, but only this form gives the printed
/// counts.
struct RmsProp {
  double rate = 1e-2;     ///< Step size, positive.
  double rho = 0.9;       ///< Decay of the mean squared gradient, in [0, 1).
  double epsilon = 1e-8;  ///< Added inside the root, at least 0.

  struct State {
    VectorX square;  ///< v.
  };

  State start(const Iterate& first) const {
    require_positive("RMSprop's rate", rate);
    require(rho >= 0.0 && rho < 1.0, "RMSprop's rho", rho, "in [0, 1)");
    require(std::isfinite(epsilon) && epsilon >= 0.0, "RMSprop's epsilon", epsilon, "finite and at least 0");
    return {.square = VectorX::Zero(first.x.size())};
  }

  Outcome update(State& state, Iterate& now, auto&) const {
    return descend(now, [&](double g, Eigen::Index i) {
      state.square[i] = rho * state.square[i] + (1.0 - rho) * (g * g);
      return rate * g / std::sqrt(state.square[i] + epsilon);
    });
  }
};

/// Trust region steepest descent: a trust region with the linear model (Nocedal and Wright 2006, Chapter 4).
///
/// The step is \f$s = -\Delta\, g/|g|\f$, the minimiser of the linear model \f$f + g\cdot s\f$ in the ball
/// \f$|s| \le \Delta\f$, with ratio = \f$(f(x) - f(x + s))/(\Delta |g|)\f$. If ratio > accept, the step is
/// taken, and Delta is multiplied by `grow` if also ratio > expand. If ratio <= accept, Delta is multiplied
/// by `shrink` and a step is tried again.
///
/// An iteration is an accepted step. Each trial costs a value of f, each iteration a gradient.
struct TrustRegion {
  double radius = 1.0;   ///< Delta at the start, positive.
  double accept = 0.5;   ///< Ratio above which a step is accepted, in [0, 1).
  double expand = 0.75;  ///< Ratio above which Delta grows, at least `accept`.
  double shrink = 0.9;   ///< Factor that reduces Delta, in (0, 1).
  double grow = 2.0;     ///< Factor that increases Delta, at least 1.
  int trials = 1000;     ///< Limit on trials in one iteration, at least 1; beyond it: not_converged.

  struct State {
    VectorX trial;  ///< x + s.
    double radius;  ///< Delta.
  };

  State start(const Iterate& first) const {
    require_positive("Trust region radius", radius);
    require(accept >= 0.0 && accept < 1.0, "Ratio that accepts", accept, "in [0, 1)");
    require(expand >= accept, "Ratio that expands", expand, "at least the ratio that accepts");
    require(shrink > 0.0 && shrink < 1.0, "Factor that shrinks the radius", shrink, "in (0, 1)");
    require(std::isfinite(grow) && grow >= 1.0, "Factor that grows the radius", grow,
            "finite and at least 1");
    require(trials >= 1, "Cap on trials", trials, "at least 1");
    return {.trial = VectorX::Zero(first.x.size()), .radius = radius};
  }

  /// Moves x to the first trial that is accepted; Outcome::not_converged after `trials` of them.
  Outcome update(State& state, Iterate& now, auto& f) const {
    const double slope = norm(now.gradient);
    if (slope == 0.0) return Outcome::ok;  // stationary: the stopping test sees no change and ends the run
    for (int trial = 0; trial < trials; ++trial) {
      state.trial = now.x - (state.radius / slope) * now.gradient;
      const double ratio = (now.value - f.value(state.trial)) / (state.radius * slope);
      if (ratio > accept) {
        now.x.swap(state.trial);
        now.evaluated = false;
        if (ratio > expand) state.radius *= grow;
        return Outcome::ok;
      }
      state.radius *= shrink;
    }
    return Outcome::not_converged;
  }
};

}  // namespace experiment
