#pragma once
#include "avi/autodiff/pack.hpp"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>

// The quartic f(x) = [(x - 1)' Sigma (x - 1)]^2 in the eigenvectors of Sigma that equal entries excite.

namespace experiment::table6_search {

constexpr int modes = 25;  ///< Symmetric eigenvectors of Sigma in 50 dimensions; the others stay at zero.

/// lambda_i, and the components of the vector of ones.
struct Spectrum {
  std::array<double, modes> lambda, ones;
};

inline Spectrum spectrum() {
  constexpr int n = 2 * modes;
  Eigen::MatrixXd sigma(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sigma(i, j) = std::pow(0.9, std::abs(i - j));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(sigma);
  Spectrum made{};
  int found = 0;
  for (int i = 0; i < n; ++i)
    if (const double part = solved.eigenvectors().col(i).sum(); std::abs(part) > 1e-8 && found < modes)
      made.lambda[found] = solved.eigenvalues()[i], made.ones[found++] = part;
  return made;
}

/// How a step is made; coefficients are those of kick (nu) and drift (eta).
enum class Form {
  type_2,      ///< The paper's HTVI: kick, then drift.
  type_3,      ///< The same with the gradient at the proximal point.
  kick_drift,  ///< Leapfrog: half kick, drift, half kick.
  drift_kick,  ///< Leapfrog: half drift, kick, half drift.
  mirror       ///< Type II with the mirror map x' Sigma x / 2 instead of x' x / 2.
};

/// When a run ends.
enum class Test {
  both,      ///< |f_k - f_{k-1}| < delta and |grad f(x_k)| < delta, as printed.
  gradient,  ///< The second alone.
  value,     ///< The first alone.
  relative   ///< Both, relative to f(x_0) and |grad f(x_0)|.
};

/// A lane of numbers: as many trajectories as a vector register holds, side by side.
constexpr int lanes = 8;
using Lane = avi::Pack<lanes>;

struct State {
  std::array<Lane, modes> z, s;

  [[nodiscard]] Lane form(const Spectrum& of) const {
    Lane sum = 0.0;
    for (int i = 0; i < modes; ++i)
      sum += of.lambda[i] * z[i] * z[i];
    return sum;
  }
  /// |grad f|.
  [[nodiscard]] Lane slope(const Spectrum& of, const Lane& form_here) const {
    Lane sum = 0.0;
    for (int i = 0; i < modes; ++i)
      sum += (of.lambda[i] * of.lambda[i]) * z[i] * z[i];
    return 4.0 * form_here * sqrt(sum);
  }
  void kick(const Spectrum& of, const Lane& nu, const Lane& form_here, bool preconditioned = false) {
    const Lane factor = 4.0 * nu * form_here;
    for (int i = 0; i < modes; ++i)
      s[i] -= (preconditioned ? factor : factor * of.lambda[i]) * z[i];
  }
  void drift(const Lane& eta) {
    for (int i = 0; i < modes; ++i)
      z[i] += eta * s[i];
  }
};

/// The form y' Sigma y at the proximal point y_i = z_i / (1 + 4 lambda_i w), w = nu eta form(y): monotone in
/// the form, by Newton's method from below.
inline Lane proximal_form(const Spectrum& of, const State& at, const Lane& strength) {
  Lane form = 0.0;
  for (int pass = 0; pass < 12; ++pass) {
    Lane value = 0.0, slope = 0.0;
    for (int i = 0; i < modes; ++i) {
      const Lane by = 1.0 / (1.0 + 4.0 * of.lambda[i] * strength * form);
      const Lane part = of.lambda[i] * at.z[i] * at.z[i] * by * by;
      value += part;
      slope -= 8.0 * of.lambda[i] * strength * part * by;
    }
    const Lane next = max(form - (form - value) / (1.0 - slope), Lane(0.0));
    bool settled = true;
    for (int l = 0; l < lanes; ++l)
      settled = settled && next[l] - form[l] <= 1e-14 * next[l];
    form = next;
    if (settled) break;
  }
  return form;
}

/// One step with coefficients nu of the kick and eta of the drift.
inline void step(const Spectrum& of, Form form, State& at, const Lane& nu, const Lane& eta) {
  switch (form) {
  case Form::type_2:
  case Form::mirror:
    at.kick(of, nu, at.form(of), form == Form::mirror);
    at.drift(eta);
    return;
  case Form::type_3: {
    const Lane strength = nu * eta, near = proximal_form(of, at, strength);
    const Lane factor = 4.0 * nu * near;
    for (int i = 0; i < modes; ++i)
      at.s[i] -= factor * of.lambda[i] * at.z[i] / (1.0 + 4.0 * of.lambda[i] * strength * near);
    at.drift(eta);
    return;
  }
  case Form::kick_drift:
    at.kick(of, 0.5 * nu, at.form(of));
    at.drift(eta);
    at.kick(of, 0.5 * nu, at.form(of));
    return;
  case Form::drift_kick:
    at.drift(0.5 * eta);
    at.kick(of, nu, at.form(of));
    at.drift(0.5 * eta);
    return;
  }
}

}  // namespace experiment::table6_search
