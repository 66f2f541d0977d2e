#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// A system to be solved: which formula, with which numbers, from where, for how long.

namespace hostile {

/// The formulas that there are; formulas.hpp has one function for each.
#define HOSTILE_FORMULAS(each)                                                                               \
  each(polynomial) each(pendula) each(charge) each(bodies) each(relativistic) each(metric) each(surface)     \
      each(toda) each(morse) each(growth) each(lennard_jones) each(repulsion) each(chain)                    \
          each(double_pendulum) each(well) each(wall) each(scatterers) each(driven) each(three_body)         \
              each(kepler) each(odd) each(top)
#define NAME(name) name,
enum class Formula { HOSTILE_FORMULAS(NAME) };
#undef NAME

/// A Hamiltonian and one orbit of it. H(q, p) = energy h(q_i / unit_i, p_i unit_i / action), where h is the
/// formula without units; so t is in units of action / energy.
struct System {
  std::string family;                     ///< What it is called in tables.
  Formula formula = Formula::polynomial;  ///< Of h.
  int n = 1;                              ///< Degrees of freedom.
  std::vector<double> c;                  ///< Coefficients of the formula.
  std::vector<int> k;                     ///< Whole numbers of the formula.
  std::vector<double> unit;               ///< Of each coordinate.
  double action = 1.0;                    ///< Unit of q p.
  double energy = 1.0;                    ///< Unit of H.
  std::vector<double> q, p;               ///< Start.
  std::vector<double> q_scale, p_scale;   ///< About the range through which each entry moves.
  /// How far a coordinate may move, over its unit, in a step of a reference that is not to jump over what is
  /// narrow.
  double reach = 1e300;
  double t = 0.0, t_end = 1.0;  ///< Of the start and of the end.
  std::string note;             ///< What a reader should know.

  /// H at any scalar S that q and p consist of.
  template <class Q>
  auto operator()(const Q& q, const Q& p) const;
};

/// The system number `index` of a seed, whatever else is drawn. No run is longer than `longest`
/// characteristic times.
System draw(std::uint64_t seed, int index, double longest);

}  // namespace hostile
