#pragma once
#include "hostile/dice.hpp"
#include "hostile/system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

/// @file
/// A system while it is drawn, and the families that draw one.

namespace hostile {

/// A system without units while it is drawn, and what the last stage needs to know.
struct Draft : System {
  double time = 6.0;       ///< Characteristic time: about a turn of the slow motion.
  double longest = 300.0;  ///< Characteristic times that a reference can follow.
  bool may_rest = true;    ///< Zero momenta make sense.
  bool own_start = false;  ///< The start is a part of the problem.

  /// Equal entries make sense.
  [[nodiscard]] bool may_be_alike() const {
    return formula == Formula::polynomial || formula == Formula::pendula || formula == Formula::chain ||
           formula == Formula::toda || formula == Formula::well || formula == Formula::metric;
  }
  void size(int dimension) {
    n = dimension;
    q.assign(n, 0.0), p.assign(n, 0.0), q_scale.assign(n, 1.0), p_scale.assign(n, 1.0);
  }
  void generic(Dice& dice, double q_size, double p_size) {
    for (int i = 0; i < n; ++i)
      q[i] = q_size * dice.between(-1.0, 1.0), p[i] = p_size * dice.between(-1.0, 1.0);
  }
  void term(double factor, std::initializer_list<int> variables) {
    c.push_back(factor);
    k.push_back(static_cast<int>(variables.size()));
    k.insert(k.end(), variables);
  }
  /// So many masses, all 1 or over some decades.
  void masses(Dice& dice, int count, double decades = 2.0) {
    const bool equal = dice.chance(0.4);
    for (int i = 0; i < count; ++i)
      c.push_back(equal ? 1.0 : dice.decades(std::pow(10.0, -0.5 * decades), std::pow(10.0, 0.5 * decades)));
  }
  template <class... Numbers>
  void say(const char* format, Numbers... numbers) {
    char text[200];
    std::snprintf(text, sizeof text, format, numbers...);
    note += text;
  }
};

/// Each draws formula, coefficients, start and characteristic time of a system.
namespace families {
/// Few or many degrees of freedom.
inline int dimension(Dice& dice, int most) {
  return std::min(most, static_cast<int>(dice.decades(1.0, most + 1.0)));
}

using Family = void(Dice&, Draft&);
Family anharmonic, henon, springs, pendula, charge, bodies, relativistic, metric, surface, toda, morse,
    growth, lennard_jones, repulsion, dense, chain, double_pendulum, well, wall, scattering, driven,
    three_body, kepler, odd, top;
}  // namespace families

}  // namespace hostile
