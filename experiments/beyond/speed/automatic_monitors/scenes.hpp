#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/core/state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Hamiltonians of many kinds, each with monitors that one would make by hand.

namespace experiment {

using V = avi::Vector<avi::Recorded, avi::dynamic>;  ///< The vectors with which a formula is recorded.
using avi::Recorded;

/// A hand-made monitor: a length (or similar scale) of the problem to a power.
struct HandMade {
  std::string name;
  avi::Formula monitor;
};

/// A problem with its orbit. The held-out problems were fixed before any formula was tuned, and not looked at
/// until the formulas were final.
struct Scene {
  std::string name;
  bool held_out;
  avi::Formula energy;
  avi::State<avi::dynamic> start;
  double time;
  std::vector<HandMade> hand_made;
};

/// A Hamiltonian or scale as a function of (q, p).
using Function = std::function<Recorded(const V&, const V&)>;
/// A scale of a problem, a function of q or of (q, p), which is tried as a monitor with each of the powers.
struct Scale {
  std::string name;
  Function scale;
  std::vector<double> powers;

  /// The default powers suit a length.
  Scale(std::string its_name, const auto& of, std::vector<double> its_powers = {0.5, 1.0, 1.5, 2.0})
      : name(std::move(its_name)), scale([of](const V& q, const V& p) {
          if constexpr (std::is_invocable_v<decltype(of), const V&>)
            return of(q);
          else
            return of(q, p);
        }),
        powers(std::move(its_powers)) {}
};

/// Scenes in the order of the tables.
class Scenes : public std::vector<Scene> {
 public:
  bool held_out = false;  ///< Marks the scenes that are added next as held out.

  /// Adds the scene of H(q, p) from a start (q, p) over a time.
  void add(const std::string& name, std::vector<double> q, std::vector<double> p, double time,
           const std::vector<Scale>& scales, const Function& energy) {
    const auto n = static_cast<Eigen::Index>(q.size());
    push_back({name,
               held_out,
               avi::Formula::of_phase(energy, n),
               {.q = Eigen::Map<Eigen::VectorXd>(q.data(), n), .p = Eigen::Map<Eigen::VectorXd>(p.data(), n)},
               time,
               {}});
    for (const Scale& scale : scales)
      for (const double power : scale.powers)
        back().hand_made.push_back(
            {fmt::format("{}^{:.2f}", scale.name, power),
             avi::Formula::of_phase([&](const V& x, const V& y) { return pow(scale.scale(x, y), power); },
                                    n)});
  }
};

// Building blocks of formulas.
inline Recorded square(const Recorded& x) { return x * x; }
inline Recorded radius_squared(const V& q) { return square(q[0]) + square(q[1]); }
/// Kinetic energy sum p_i^2 / (2 m_i), with two coordinates for each mass; without masses, all are 1.
inline Recorded kinetic(const V& p, const std::vector<double>& masses = {}) {
  Recorded sum = 0.0;
  for (Eigen::Index i = 0; i < p.size(); ++i)
    sum += square(p[i]) * (0.5 / (masses.empty() ? 1.0 : masses[static_cast<std::size_t>(i / 2)]));
  return sum;
}
/// The sum over all pairs in the plane of m_i m_j / r_ij^k.
inline Recorded pairs(const V& q, const std::vector<double>& masses, double k) {
  Recorded sum = 0.0;
  for (std::size_t j = 1; j < masses.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const auto a = static_cast<Eigen::Index>(2 * i), b = static_cast<Eigen::Index>(2 * j);
      sum += (masses[i] * masses[j]) * pow(square(q[a] - q[b]) + square(q[a + 1] - q[b + 1]), -0.5 * k);
    }
  return sum;
}
/// The lengths (sum over pairs of m_i m_j / r_ij^k)^(-1/k) for k = 1, 2, 3.
inline std::vector<Scale> pair_lengths(const std::vector<double>& masses) {
  std::vector<Scale> scales;
  for (const double k : {1.0, 2.0, 3.0})
    scales.push_back({"pairs" + std::to_string(static_cast<int>(k)),
                      [=](const V& q) { return pow(pairs(q, masses, k), -1.0 / k); }});
  return scales;
}
/// The scale |q| in the plane.
inline const Scale radius{"r", [](const V& q) { return sqrt(radius_squared(q)); }};
/// The scale q[0], where q[0] is a distance.
inline const Scale distance{"r", [](const V& q) { return q[0]; }};
/// The scale sin q[0], where q[0] is the angle from a pole.
inline const Scale sine{"sine", [](const V& q) { return sin(q[0]); }};
/// A scale of a quartic well.
inline const Scale stiffness{
    "stiffness", [](const V& q) { return 1.0 / (1.0 + square(q[0])); }, {0.25, 0.5, 1.0}};

void add_celestial(Scenes&);  ///< Inverse-square attraction, and a charge in the field of a dipole.
void add_first(Scenes&);      ///< Oscillators, springs, walls and molecules, looked at from the beginning.
void add_further(Scenes&);    ///< Ten that were held out from a first search and have been looked at since.
void add_seen(Scenes&);       ///< Twelve drawn by a rule and looked at since.
void add_held_out(Scenes&);   ///< Twelve drawn by the same rule and held out.

}  // namespace experiment
