#pragma once
#include "beyond/speed/work_precision/arena.hpp"
#include "beyond/speed/work_precision/family.hpp"

#include "avi/problems/chain.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/perturbed_kepler.hpp"

#include <vector>

/// @file
/// The problems of the comparison and who adds which methods to them.

namespace experiment::work_precision {

using KeplerArena = Arena<avi::Kepler>;
using PerturbedArena = Arena<avi::PerturbedKepler>;
using HenonArena = Arena<avi::HenonHeiles>;
using EightArena = Arena<avi::NBody<3>>;
using ClusterArena = Arena<avi::NBody<7>>;

/// 64 masses on a line (avi::Chain), as kinetic and potential energy.
struct LongChain : avi::Chain {
  static constexpr int dimension = 64;
  template <class P>
  auto kinetic(const P& p) const {
    auto sum = 0.5 * (p[0] * p[0]);
    for (Eigen::Index i = 1; i < p.size(); ++i)
      sum += 0.5 * (p[i] * p[i]);
    return sum;
  }
  template <class Q>
  auto potential(const Q& q) const {
    return (*this)(q, (q - q).eval());
  }
  template <class S>
  avi::Vector<S, 64> potential_gradient(const avi::Vector<S, 64>& q) const {
    return d_dq(q, q);
  }
};
using ChainArena = Arena<LongChain>;

/// Explicit methods of this library.
void add_explicit(Scene&, const KeplerArena&);
void add_explicit(Scene&, const PerturbedArena&);
void add_explicit(Scene&, const HenonArena&);
void add_explicit(Scene&, const EightArena&);
void add_explicit(Scene&, const ClusterArena&);
void add_explicit(Scene&, const ChainArena&);

/// Gauss collocation, a family for each order.
void add_collocation(Scene&, const KeplerArena&);
void add_collocation(Scene&, const PerturbedArena&);
void add_collocation(Scene&, const HenonArena&);
void add_collocation(Scene&, const EightArena&);
void add_collocation(Scene&, const ClusterArena&);
void add_collocation(Scene&, const ChainArena&);

/// HTVI of orders 4 to 16.
void add_htvi(Scene&, const KeplerArena&);
void add_htvi(Scene&, const PerturbedArena&);
void add_htvi(Scene&, const HenonArena&);
void add_htvi(Scene&, const EightArena&);

/// Integrators of other libraries.
template <class A>
void add_gsl(Scene&, const A&);
template <class A>
void add_odeint(Scene&, const A&);
template <class A>
void add_sundials(Scene&, const A&);

/// What the comparison covers.
enum class Grid {
  quick,    ///< One short scene, for tests.
  reduced,  ///< What `make figures` runs.
  full
};

std::vector<Scene> scenes(Grid grid);

/// `GSL 2.7.1, Boost 1.74, SUNDIALS absent`.
std::string peers_present();

}  // namespace experiment::work_precision
