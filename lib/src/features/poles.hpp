#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "src/autodiff/factor.hpp"
#include "src/choice/sketch.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

/// @file
/// The poles of H, read from its formula, and a monitor that is made of the distances to them.

namespace avi::detail {

/// The functions u(q) that H divides by, or takes a negative power or the logarithm of: squared distances of
/// bodies, a radius, the sine of an angle from a pole of the coordinates, all of them softened or not. With
/// the length \f$s_k = |u_k|^{1/d_k}\f$, where \f$u_k\f$ is of degree \f$d_k\f$ in q (2 for a sum of
/// squares), H is of the order \f$s_k^{-a_k}\f$ near a pole. The motion there changes with the frequency
/// \f$\phi_k = w_k s_k^{-1-a_k/2}\f$, where \f$w_k\f$ hardly depends on the place: in free fall towards a
/// mass \f$\mu\f$ at the distance r it is \f$\sqrt{2\mu}\, r^{-3/2}\f$. The monitor is \f$g = 1/\ell\f$ with
/// \f[ \ell = \rho^2 + \frac{\rho}{\sqrt\phi}\, \frac{H - H_0}{2E} \sum_k \Bigl(1 + \frac{a_k}{2}\Bigr)
/// \phi_k, \qquad \rho = \sqrt{w_0} + \sqrt\phi, \qquad \phi = \sum_k \phi_k, \qquad E = e_0 + \sum_k |s_k\,
/// \partial H/\partial s_k| = e_0 + \sum_k e_k s_k^{-a_k} \f] and a mean kinetic energy \f$e_0\f$. The
/// constant \f$w_0\f$ is for orbits that move freely between poles. A plain sum \f$w_0 + \phi\f$ would vanish
/// at complex times near those at which its terms are equal, and would cost twice the steps. The last term of
/// \f$\ell\f$ vanishes along the orbit. It replaces half of the potential energy by half of the kinetic
/// energy, which halves the sweeps of a step.
class Poles {
 public:
  /// Finds the poles of H, a node of a graph of (q, p). If there are more than `most`, none is taken.
  Poles(const ExpressionGraph& graph, int energy);

  /// Returns true if there are no poles.
  [[nodiscard]] bool none() const { return poles_.empty(); }
  /// Number of poles.
  [[nodiscard]] std::size_t size() const { return poles_.size(); }
  /// Node of the function u of this pole.
  [[nodiscard]] int node(std::size_t pole) const { return poles_[pole].node; }
  /// The constants \f$w_k, e_k\f$ of one pole after the other: their largest values at some points of a
  /// sketch, found from the derivatives of H along \f$s_k\f$ and the masses. @param metric diagonal of H_pp
  /// @param seen number of coordinates, without time
  [[nodiscard]] std::vector<double> constants(const Sketch& sketch, const VectorX& metric,
                                              Eigen::Index seen) const;
  /// A divisor u of degree 2 or more with little effect.
  struct Light {
    int node;         ///< Node of u.
    double degree;    ///< Degree of u.
    double strength;  ///< Value of |dH/d ln s| at s = 1.
    int steepness;    ///< Power of 1/s with which that changes.
    double reach;     ///< Half of the largest s on the sketch.

    /// Square of the length s, from u.
    template <class S>
    [[nodiscard]] S square(const S& u) const {
      using std::abs;
      return degree == 2.0 ? u : power(abs(u), 2.0 / degree);
    }
  };
  /// The divisors that are not felt on a sketch, as far as two of its points show: |dH/d ln s| is less than
  /// `felt`. Not all of them are poles of H, for example the u of 1 / (1 + 1/u).
  [[nodiscard]] std::vector<Light> unfelt(const Sketch& sketch, double felt) const;
  /// Value of |dH/d ln s| for a divisor of this degree. @param at values of all nodes up to H
  [[nodiscard]] double change(int node, double degree, const std::vector<double>& at) const;
  /// Adds the node of \f$\ell\f$ to a graph that contains H as the one of the constructor does.
  /// @param constants \f$w_0, e_0\f$, then those of the poles @param beside what else belongs to \f$\phi\f$
  int rate(ExpressionGraph& graph, const Factor& energy_at_start, const std::vector<double>& constants,
           const Factor& beside = 0.0) const;

  static constexpr std::size_t most = 24;  ///< Largest number of poles of one H.

 private:
  struct Pole {
    int node;                             // u
    double degree;                        // d
    double power;                         // power of u in H, negative; nearly 0 for a logarithm
    [[nodiscard]] int steepness() const;  // a, a whole number
  };

  const ExpressionGraph* graph_;
  int energy_;
  std::vector<unsigned char> on_;  // see dependences()
  std::vector<Pole> poles_;
  std::vector<Pole> others_;  // divisors that are not poles
};

}  // namespace avi::detail
