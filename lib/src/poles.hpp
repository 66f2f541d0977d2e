#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "factor.hpp"
#include "sketch.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

/// @file
/// The poles of H, read off its formula, and a monitor that is made of the distances to them.

namespace avi::detail {

/// The functions u(q) that H divides by, or has a negative power or the logarithm of: squared distances of
/// bodies, a radius, the sine of an angle from a pole of the coordinates, all of them softened or not. With
/// the length \f$s_k = |u_k|^{1/d_k}\f$, where \f$u_k\f$ is of degree \f$d_k\f$ in q (2 for a sum of
/// squares), H is of the order \f$s_k^{-a_k}\f$ near a pole, and what moves there changes with the frequency
/// \f$\phi_k = w_k s_k^{-1-a_k/2}\f$, where \f$w_k\f$ hardly depends on the place: in free fall towards a
/// mass \f$\mu\f$ at the distance r it is \f$\sqrt{2\mu}\, r^{-3/2}\f$. The monitor is \f$g = 1/\ell\f$ with
/// \f[ \ell = \rho^2 + \frac{\rho}{\sqrt\phi}\, \frac{H - H_0}{2E} \sum_k \Bigl(1 + \frac{a_k}{2}\Bigr)
/// \phi_k, \qquad \rho = \sqrt{w_0} + \sqrt\phi, \qquad \phi = \sum_k \phi_k, \qquad E = e_0 + \sum_k |s_k\,
/// \partial H/\partial s_k| = e_0 + \sum_k e_k s_k^{-a_k} \f] and a mean kinetic energy \f$e_0\f$. The
/// constant \f$w_0\f$ is for orbits that move freely between poles; \f$w_0 + \phi\f$ would vanish at complex
/// times near those at which the two are equal, and cost twice the steps. The last term of \f$\ell\f$
/// vanishes along the orbit. It replaces half of the potential energy by half of the kinetic one, which takes
/// a step half as many sweeps.
class Poles {
 public:
  /// Those of H as a node of a graph of (q, p), `most` of them at most: with more, none.
  Poles(const ExpressionGraph& graph, int energy);

  /// There are none.
  [[nodiscard]] bool none() const { return poles_.empty(); }
  /// How many there are.
  [[nodiscard]] std::size_t size() const { return poles_.size(); }
  /// The constants \f$w_k, e_k\f$ of one pole after the other: the largest on some points of a sketch, found
  /// from the derivatives of H along \f$s_k\f$ and the masses. @param metric diagonal of H_pp @param seen
  /// number of coordinates but time
  [[nodiscard]] std::vector<double> constants(const Sketch& sketch, const VectorX& metric,
                                              Eigen::Index seen) const;
  /// A divisor u of degree 2 or more, of which little is felt.
  struct Light {
    int node;         ///< u,
    double degree;    ///< and its degree.
    double strength;  ///< |dH/d ln s| at s = 1,
    int steepness;    ///< which changes with this power of 1/s.
    double reach;     ///< Half of the largest s on the sketch.

    /// The square of the length s, from u.
    template <class S>
    [[nodiscard]] S square(const S& u) const {
      using std::abs;
      return degree == 2.0 ? u : power(abs(u), 2.0 / degree);
    }
  };
  /// Those that are felt nowhere on a sketch: |dH/d ln s| is less than `felt`. Not all of them are poles of
  /// H, as the u of 1 / (1 + 1/u).
  [[nodiscard]] std::vector<Light> unfelt(const Sketch& sketch, double felt) const;
  /// |dH/d ln s| of a divisor of this degree where all nodes up to H have these values.
  [[nodiscard]] double change(int node, double degree, const std::vector<double>& at) const;
  /// The node of \f$\ell\f$ in a graph that H is a part of as in the constructor.
  /// @param constants \f$w_0, e_0\f$, then those of the poles
  int rate(ExpressionGraph& graph, const Factor& energy_at_start, const std::vector<double>& constants) const;

  static constexpr std::size_t most = 24;  ///< Largest number of poles of one H that are looked at.

 private:
  struct Pole {
    int node;                             // u
    double degree;                        // d
    double power;                         // of u in H, negative; of a logarithm nearly 0
    [[nodiscard]] int steepness() const;  // a, a whole number
  };
  void divisors(int node, std::array<std::vector<char>, 2>& seen);
  void follow(std::vector<double>& powers, std::size_t from,
              double (*otherwise)(Operation, double, double)) const;
  [[nodiscard]] double power_in(int node, int base) const;
  [[nodiscard]] double degree(int node) const;

  const ExpressionGraph* graph_;
  int energy_;
  std::vector<unsigned char> on_;  // see dependences()
  std::vector<Pole> poles_;
  std::vector<Pole> others_;  // divisors that are none
};

}  // namespace avi::detail
