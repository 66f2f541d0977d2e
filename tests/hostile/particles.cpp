#include "hostile/draft.hpp"

/// @file
/// Families of bodies, charges, atoms and motions on surfaces.

namespace hostile::families {

void charge(Dice& dice, Draft& s) {
  s.k = {dice.whole(0, 3)};
  s.size(s.k[0] == 1 || s.k[0] == 2 ? 3 : 2);
  s.formula = Formula::charge;
  const double field = dice.decades(0.1, 100.0);
  s.c = {field, s.k[0] == 1 && dice.chance(0.7) ? 0.0 : dice.chance(0.3) ? 0.0 : dice.decades(0.01, 1.0)};
  for (int i = 0; i < 3; ++i)
    s.c.push_back(dice.chance(0.4) ? 0.0 : dice.decades(0.01, 10.0));
  s.generic(dice, 1.0, 1.0);
  if (s.k[0] == 1) {
    s.q[0] = dice.decades(1.0, 10.0), s.q[1] = 0.0;
    for (double& p : s.p)
      p *= dice.decades(0.01, 1.0);
  }
  s.longest = 300.0 / std::max(1.0, field / (s.k[0] == 1 ? 10.0 : 1.0));
  s.say("kind %d, field %.3g, growth %.3g", s.k[0], field, s.c[1]);
}

void bodies(Dice& dice, Draft& s) {
  const int d = dice.whole(2, 3), count = dice.whole(2, 4);
  s.size(d * count);
  s.formula = Formula::bodies;
  s.k = {d};
  s.c = {dice.chance(0.6) ? 0.0 : dice.decades(1e-4, 0.1)};
  const bool planetary = dice.chance(0.65);
  s.say("%d in %dD, softening^2 %.2g, %s, masses", count, d, s.c[0],
        planetary ? "about a heavy one" : "thrown together");
  for (int i = 0; i < count; ++i) {
    s.c.push_back(i == 0             ? 1.0
                  : planetary        ? dice.decades(1e-12, 1e-2)
                  : dice.chance(0.5) ? dice.decades(0.1, 1.0)
                                     : dice.decades(1e-12, 1.0));
    s.say(" %.2g", s.c.back());
  }
  if (!planetary) {
    for (int i = 0; i < count; ++i)
      for (int a = 0; a < d; ++a)
        s.q[d * i + a] = dice.between(-1.0, 1.0), s.p_scale[d * i + a] = s.c[1 + i],
                    s.p[d * i + a] = s.c[1 + i] * 0.7 * dice.between(-1.0, 1.0);
    s.time = 3.0, s.longest = 10.0;
    return;
  }
  double radius = 1.0;
  for (int i = 1; i < count; ++i) {  // each at a pericentre or apocentre of an ellipse
    const double e = dice.chance(0.4) ? dice.between(0.9, 0.99) : dice.between(0.0, 0.8), a = radius,
                 m = s.c[1 + i];
    const bool near = dice.chance(0.5);
    const double r = near ? a * (1.0 - e) : a * (1.0 + e),
                 v = std::sqrt((near ? 1.0 + e : 1.0 - e) / (near ? 1.0 - e : 1.0 + e) / a);
    const double angle = dice.between(0.0, 6.283), tilt = d == 3 ? dice.between(-0.5, 0.5) : 0.0;
    const double x = std::cos(angle), y = std::sin(angle);
    s.q[d * i] = r * x, s.q[d * i + 1] = r * y;
    s.p[d * i] = -m * v * y * std::cos(tilt), s.p[d * i + 1] = m * v * x * std::cos(tilt);
    if (d == 3) s.p[d * i + 2] = m * v * std::sin(tilt);
    for (int b = 0; b < d; ++b) {
      s.p[b] -= s.p[d * i + b];
      s.q_scale[d * i + b] = a, s.p_scale[d * i + b] = m * v;
      s.q_scale[b] = std::max(i == 1 ? 0.0 : s.q_scale[b], a * m),
      s.p_scale[b] = std::max(i == 1 ? 0.0 : s.p_scale[b], m * v);
    }
    radius *= dice.decades(1.5, 6.0);
    s.say(", e %.3f", e);
  }
  s.time = 6.3, s.longest = 60.0;
}

void relativistic(Dice& dice, Draft& s) {
  s.size(dice.whole(1, 3));
  s.formula = Formula::relativistic;
  s.k = {dice.whole(0, 3)};
  s.c = {dice.chance(0.3) ? 1.0 : dice.decades(0.1, 1e5), dice.decades(0.1, 10.0), dice.decades(0.1, 10.0)};
  const double speed = dice.decades(0.1, 10.0);
  s.generic(dice, dice.decades(0.1, 10.0), s.c[1] * speed);
  for (int i = 0; i < s.n; ++i)
    s.p_scale[i] = s.c[1] * speed;
  s.time = 6.0 * std::sqrt(s.c[1] / s.c[2]);
  s.longest = 100.0;
  s.say("kind %d, c %.3g, m %.3g, strength %.3g, p/m %.3g", s.k[0], s.c[0], s.c[1], s.c[2], speed);
}

void metric(Dice& dice, Draft& s) {
  s.size(dimension(dice, dice.chance(0.15) ? 60 : 20));
  s.formula = Formula::metric;
  s.k = {dice.whole(0, 2)};
  s.c = {dice.decades(0.01, 3.0) / (s.k[0] == 2 ? s.n : 1), dice.chance(0.3) ? 0.0 : dice.decades(0.1, 10.0)};
  s.generic(dice, dice.decades(0.1, 2.0), dice.decades(0.1, 2.0));
  s.longest = s.n > 20 ? 10.0 : 100.0;
  s.say("kind %d, curvature %.3g, stiffness %.3g", s.k[0], s.c[0], s.c[1]);
}

void surface(Dice& dice, Draft& s) {
  s.formula = Formula::surface;
  s.k = {dice.whole(0, 3)};
  s.size(s.k[0] == 3 ? 3 : 2);
  s.generic(dice, 1.0, 1.0);
  s.c = {dice.decades(0.1, 3.0)};
  if (s.k[0] == 0) s.q[0] = dice.between(0.3, 2.8);
  if (s.k[0] == 1) s.q[1] = dice.decades(0.1, 10.0), s.longest = 3.0;
  if (s.k[0] == 2) s.c[0] = 1.0 + dice.decades(0.01, 10.0);
  if (s.k[0] == 3) {
    s.c[0] = 1.0;
    const double r = dice.decades(7.0, 100.0), turn = std::sqrt(r) * dice.between(0.9, 1.1);
    s.q = {0.0, r, 0.0}, s.p = {-std::sqrt((1.0 - 2.0 / r) * (1.0 + turn * turn / (r * r))), 0.0, turn};
    s.q_scale = {r, r, 1.0};
    s.time = 6.3 * r * std::sqrt(r), s.longest = 30.0, s.own_start = true;
  }
  s.may_rest = s.k[0] == 0;
  s.say("kind %d, parameter %.3g", s.k[0], s.c[0]);
}

void lennard_jones(Dice& dice, Draft& s) {
  const int count = dice.whole(2, 4);
  s.size(2 * count);
  s.formula = Formula::lennard_jones;
  s.masses(dice, count);
  const double apart = dice.chance(0.5) ? dice.between(1.1, 2.0) : dice.decades(2.0, 300.0),
               speed = dice.decades(0.01, 3.0);
  for (int i = 0; i < count; ++i) {
    const double angle = 6.2831853 * i / count + dice.between(-0.2, 0.2);
    const double radius = apart / (2.0 * std::sin(3.14159265 / count)) * dice.between(1.0, 1.1);
    s.q[2 * i] = radius * std::cos(angle), s.q[2 * i + 1] = radius * std::sin(angle);
    for (int a = 0; a < 2; ++a)
      s.p[2 * i + a] =
          s.c[i] * speed *
          (apart > 2.0 ? -s.q[2 * i + a] / radius + dice.between(-0.02, 0.02) : dice.between(-1.0, 1.0)),
                  s.p_scale[2 * i + a] = s.c[i] * std::max(speed, 1.0);
  }
  s.time = apart > 2.0 ? apart / speed : 1.0, s.longest = apart > 2.0 ? 3.0 : 30.0;
  s.say("apart %.3g, speed %.3g", apart, speed);
}

void repulsion(Dice& dice, Draft& s) {
  s.size(dice.whole(1, 4));
  s.formula = Formula::repulsion;
  s.k = {dice.whole(1, 4)};
  s.masses(dice, s.n, 1.0);
  const double from = dice.decades(1e-2, 1e4), strength = dice.decades(0.1, 10.0),
               spring = dice.chance(0.3) ? strength / std::pow(from, 2.0 + s.k[0]) : 0.0;
  s.c.push_back(strength), s.c.push_back(spring);
  const double speed = std::sqrt(strength / std::pow(from, s.k[0])) * dice.decades(0.1, 10.0);
  for (int i = 0; i < s.n; ++i) {
    s.q[i] = (i == 0 ? 0.0 : s.q[i - 1]) + from * dice.between(0.5, 1.5);
    s.p_scale[i] = s.c[i] * speed, s.q_scale[i] = from;
    s.p[i] = -s.p_scale[i] * dice.between(i == 0 ? -1.0 : 0.0, 1.0);
  }
  s.time = from / speed, s.longest = 30.0;
  s.say("power %d, from %.3g, speed %.3g, spring %.3g", s.k[0], from, speed, spring);
}

void scattering(Dice& dice, Draft& s) {
  s.size(dice.whole(2, 3));
  s.formula = Formula::scatterers;
  s.k = {dice.whole(0, 2), dice.whole(1, 4)};
  const bool boxed = dice.chance(0.3);
  s.c = {boxed ? 1.0 : 0.0};
  for (int i = 0; i < s.k[1]; ++i) {
    s.c.push_back(dice.sign() * dice.decades(0.1, 10.0)), s.c.push_back(dice.decades(0.03, 1.0));
    s.reach = std::min(s.reach, 30.0 * s.c.back());
    for (int a = 0; a < s.n; ++a)
      s.c.push_back(dice.between(-1.0, 1.0));
  }
  const double from = boxed ? 1.5 : dice.decades(2.0, 300.0), speed = dice.decades(0.3, 10.0);
  s.generic(dice, 1.0, 0.02 * speed);
  s.q[0] = -from, s.p[0] = speed;
  for (int i = 0; i < s.n; ++i)
    s.p_scale[i] = speed;
  s.time = from / speed, s.longest = boxed ? 30.0 : 4.0;
  s.say("kind %d, %d centres, from %.3g, speed %.3g%s", s.k[0], s.k[1], from, speed, boxed ? ", boxed" : "");
}

void three_body(Dice& dice, Draft& s) {
  s.size(dice.whole(2, 3));
  s.formula = Formula::three_body;
  s.c = {dice.chance(0.3) ? 0.5 : dice.decades(1e-9, 0.5)};
  s.generic(dice, 0.1, 0.1);
  if (dice.chance(0.5)) {  // about the heavy one
    const double r = dice.between(0.2, 0.7);
    s.q[0] = r - s.c[0], s.p[1] = std::sqrt((1.0 - s.c[0]) / r) * dice.between(0.7, 1.2) * dice.sign();
    s.say("inside, ");
  } else {  // near a triangle's corner
    s.q[0] += 0.5 - s.c[0], s.q[1] += 0.8660254, s.p[0] -= 0.8660254, s.p[1] += 0.5 - s.c[0];
    s.say("at the corner, ");
  }
  s.own_start = true;
  s.longest = 30.0;
  s.say("mass %.3g", s.c[0]);
}

void kepler(Dice& dice, Draft& s) {
  s.size(dice.whole(2, 3));
  s.formula = Formula::kepler;
  s.k = {dice.chance(0.4) ? 0 : dice.whole(1, 3)};
  s.c = {dice.decades(1e-6, 0.1)};
  const double e = dice.chance(0.5) ? 1.0 - dice.decades(1e-4, 0.3) : dice.between(0.0, 0.7);
  const bool near = dice.chance(0.5);
  const double r = near ? 1.0 - e : 1.0 + e,
               v = std::sqrt(near ? (1.0 + e) / (1.0 - e) : (1.0 - e) / (1.0 + e)),
               angle = dice.between(0.0, 6.283);
  s.q[0] = r * std::cos(angle), s.q[1] = r * std::sin(angle);
  s.p[0] = -v * std::sin(angle), s.p[1] = v * std::cos(angle);
  if (s.n == 3 && dice.chance(0.7)) s.p[2] = 0.3 * v * dice.between(-1.0, 1.0);
  s.own_start = true, s.may_rest = dice.chance(0.1);
  s.say("kind %d, strength %.2g, 1 - e = %.2g, %s", s.k[0], s.c[0], 1.0 - e, near ? "near" : "far");
}

void top(Dice& dice, Draft& s) {
  s.size(3);
  s.formula = Formula::top;
  s.c = {1.0, dice.decades(0.1, 2.0), dice.decades(0.1, 3.0)};
  s.generic(dice, 1.0, 1.0);
  s.q[0] = dice.between(0.3, 2.5);
  s.p[2] *= dice.decades(1.0, 30.0), s.p[1] = s.p[2] * std::cos(s.q[0]) + 0.3 * s.p[1];
  s.p_scale[2] = s.p_scale[1] = std::abs(s.p[2]);
  s.own_start = true, s.longest = 30.0;
  s.say("figure %.3g, weight %.3g, spin %.3g", s.c[1], s.c[2], s.p[2]);
}

}  // namespace hostile::families
