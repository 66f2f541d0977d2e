#pragma once
#include "work_precision/arena.hpp"
#include "work_precision/family.hpp"

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

/// Explicit methods of this library.
void add_explicit(Scene&, const KeplerArena&);
void add_explicit(Scene&, const PerturbedArena&);
void add_explicit(Scene&, const HenonArena&);
void add_explicit(Scene&, const EightArena&);

/// HTVI of every order that was compiled in; one source file compiled once for each Taylor order r.
template <int r>
void add_htvi(Scene&, const KeplerArena&);
template <int r>
void add_htvi(Scene&, const PerturbedArena&);
template <int r>
void add_htvi(Scene&, const HenonArena&);
template <int r>
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
