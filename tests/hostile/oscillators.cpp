#include "hostile/draft.hpp"

/// @file
/// Families of oscillators, chains and wells.

namespace hostile::families {

void anharmonic(Dice& dice, Draft& s) {
  s.size(dimension(dice, 20));
  s.formula = Formula::polynomial;
  const double quartic = dice.chance(0.5) ? dice.decades(0.01, 100.0) : 0.0;
  for (int i = 0; i < s.n; ++i) {
    s.term(dice.decades(0.1, 10.0), {s.n + i, s.n + i});
    s.term(dice.decades(0.1, 10.0), {i, i});
    if (quartic > 0.0) s.term(quartic, {i, i, i, i});
  }
  const double cubic = dice.chance(0.5) ? dice.decades(0.001, 0.5) : 0.0;
  for (int j = 0; j < s.n && cubic > 0.0; ++j)
    s.term(cubic * dice.sign(), {dice.whole(0, s.n - 1), dice.whole(0, s.n - 1), dice.whole(0, s.n - 1)});
  for (int j = 0; j < s.n; ++j) {
    const int a = dice.whole(0, s.n - 1), b = dice.whole(0, s.n - 1);
    s.term(quartic * dice.between(0.0, 2.0), {a, a, b, b});
  }
  s.generic(dice, dice.decades(0.1, 3.0), dice.decades(0.1, 3.0));
  s.longest = 100.0;
  s.say("quartic %.3g, cubic %.3g", quartic, cubic);
}

void henon(Dice& dice, Draft& s) {
  s.size(2);
  s.formula = Formula::polynomial;
  for (int i = 0; i < 4; ++i)
    s.term(0.5, {i, i});
  s.term(1.0, {0, 0, 1}), s.term(-1.0 / 3.0, {1, 1, 1});
  const double size = dice.decades(0.02, 0.6);
  s.generic(dice, size, size);
  s.say("amplitude %.3g", size);
}

void springs(Dice& dice, Draft& s) {
  s.size(dimension(dice, 12));
  s.formula = Formula::polynomial;
  const double ratio = dice.chance(0.3) ? 1.0 : dice.decades(1.0, 1e4),
               spread = dice.chance(0.5) ? 1.0 : dice.decades(1.0, 1e8);
  for (int i = 0; i < s.n; ++i) {
    const double w = i == 0 ? 1.0 : i == 1 ? ratio : dice.decades(1.0, ratio), m = dice.decades(0.1, 10.0);
    s.term(0.5 / m, {s.n + i, s.n + i}), s.term(0.5 * m * w * w, {i, i});
    const double size = i == 1 ? 1.0 / spread : dice.decades(1.0 / spread, 1.0);
    s.q_scale[i] = size, s.p_scale[i] = m * w * size;
    s.q[i] = size * dice.between(-1.0, 1.0), s.p[i] = s.p_scale[i] * dice.between(-1.0, 1.0);
  }
  const bool coupled = dice.chance(0.5);
  for (int i = 0; i + 1 < s.n && coupled; ++i)
    if (dice.chance(0.5))
      s.term(dice.between(0.0, 0.1), {i, i + 1});
    else
      s.term(0.1 * dice.between(-1.0, 1.0), {i, i, i + 1});
  s.longest = std::min(300.0, 5e3 / ratio);
  s.say("frequencies to %.3g, amplitudes down to %.1g, %s", ratio, 1.0 / spread,
        coupled ? "coupled" : "uncoupled");
}

void pendula(Dice& dice, Draft& s) {
  s.size(dimension(dice, 10));
  s.formula = Formula::pendula;
  s.masses(dice, s.n, 4.0);
  const bool free = dice.chance(0.2);
  const double fast = dice.chance(0.3) ? dice.decades(1.0, 1e3) : 1.0;
  for (int i = 0; i < s.n; ++i)
    s.c.push_back(free ? 0.0 : s.c[i] * dice.decades(1.0, fast * fast));
  const double coupling = dice.chance(0.5) ? dice.decades(1e-3, 1.0) : 0.0;
  for (int i = 0; i < s.n; ++i)
    s.c.push_back(coupling * s.c[i]);
  const double turn = dice.decades(0.1, 30.0);
  s.generic(dice, 3.1, 1.0);
  for (int i = 0; i < s.n; ++i)
    s.p_scale[i] = s.c[i] * turn * std::sqrt(std::max(1.0, s.c[s.n + i] / s.c[i])), s.p[i] *= s.p_scale[i];
  s.longest = 300.0 / std::max(fast, 1.0 + turn);
  s.say("%s, speeds to %.3g, frequencies to %.3g, coupling %.3g", free ? "free" : "weighed", turn, fast,
        coupling);
}

void toda(Dice& dice, Draft& s) {
  s.size(1 + dimension(dice, 29));
  s.formula = Formula::toda;
  s.masses(dice, s.n);
  s.k = {dice.whole(0, 2)};
  s.generic(dice, dice.decades(0.1, 3.0), dice.decades(0.1, 3.0));
  s.longest = 1000.0 / s.n;
  s.say("kind %d", s.k[0]);
}

void morse(Dice& dice, Draft& s) {
  s.size(dimension(dice, 6));
  s.formula = Formula::morse;
  s.masses(dice, s.n);
  s.k = {dice.whole(0, 1)};
  s.c.push_back(dice.decades(0.1, 100.0)), s.c.push_back(dice.decades(0.1, 10.0));
  const double steep = s.c.back(), size = dice.decades(0.001, 0.5);
  s.generic(dice, size / steep, size);
  for (int i = 0; i < s.n; ++i)
    s.q_scale[i] = size / steep, s.p_scale[i] = size * std::sqrt(2.0 * s.c[i] * s.c[s.n]),
    s.p[i] *= s.p_scale[i] / size;
  s.time = 6.3 / (steep * std::sqrt(s.c[s.n]));
  s.say("kind %d, depth %.3g, steepness %.3g, size %.3g", s.k[0], s.c[s.n], steep, size);
}

void growth(Dice& dice, Draft& s) {
  s.k = {dice.whole(0, 3)};
  s.size(s.k[0] == 2 ? 1 : dice.whole(1, 6));
  s.formula = Formula::growth;
  s.c = {dice.decades(0.1, 3.0)};
  s.generic(dice, 3.0, 1.0);
  if (s.k[0] == 2) s.may_rest = false;
  if (s.k[0] == 3)
    for (double& q : s.q)
      q *= 0.3;
  s.time = s.k[0] == 0 ? 1.0 : 6.0;
  s.longest = 100.0;
  s.say("kind %d, rate %.3g", s.k[0], s.c[0]);
}

void dense(Dice& dice, Draft& s) {
  s.size(1 + dimension(dice, dice.chance(0.1) ? 59 : 19));
  s.formula = Formula::polynomial;
  const bool whirl = dice.chance(0.3);
  for (const int first : {0, s.n}) {  // A A^T / n + 1 for each
    std::vector<double> a(s.n * s.n);
    for (double& x : a)
      x = dice.between(-1.7, 1.7);
    for (int i = 0; i < s.n; ++i)
      for (int j = 0; j <= i; ++j) {
        double sum = i == j ? 0.1 : 0.0;
        for (int l = 0; l < s.n; ++l)
          sum += a[i * s.n + l] * a[j * s.n + l] / s.n;
        s.term(i == j ? 0.5 * sum : sum, {first + i, first + j});
      }
  }
  for (int i = 0; i + 1 < s.n && whirl; ++i) {
    const double w = dice.between(-0.5, 0.5);
    s.term(w, {i, s.n + i + 1}), s.term(-w, {i + 1, s.n + i});
  }
  const double quartic = dice.chance(0.3) ? dice.decades(0.01, 1.0) : 0.0;
  for (int i = 0; i < s.n && quartic > 0.0; ++i)
    s.term(quartic, {i, i, i, i});
  s.generic(dice, 1.0, 1.0);
  s.longest = std::min(100.0, 2e4 / (s.n * s.n));
  s.say("quartic %.3g%s", quartic, whirl ? ", turning" : "");
}

void chain(Dice& dice, Draft& s) {
  s.size(dimension(dice, 60));
  s.formula = Formula::chain;
  s.masses(dice, s.n);
  s.k = {dice.whole(0, 1)};
  const double size = dice.decades(0.01, 1.0);
  s.c.push_back(dice.chance(0.5) ? 0.0 : dice.between(0.0, 0.3)),
      s.c.push_back(dice.chance(0.3) ? 0.0 : dice.decades(0.1, 10.0));
  s.c.push_back(dice.chance(0.7) ? 0.0 : dice.decades(0.1, 10.0));
  const bool wave = dice.chance(0.3);
  s.generic(dice, size, size);
  for (int i = 0; i < s.n; ++i) {
    if (wave) s.q[i] = size * std::sin(3.14159265358979 * (i + 1) / (s.n + 1)), s.p[i] = 0.0;
    s.p[i] *= std::sqrt(s.c[i]), s.q_scale[i] = size, s.p_scale[i] = size * std::sqrt(s.c[i]);
  }
  s.longest = std::min(300.0, 3e3 / s.n);
  s.say("alpha %.3g, beta %.3g, own %.3g, size %.3g%s", s.c[s.n], s.c[s.n + 1], s.c[s.n + 2], size,
        wave ? ", one wave" : "");
}

void double_pendulum(Dice& dice, Draft& s) {
  s.size(2);
  s.formula = Formula::double_pendulum;
  for (int i = 0; i < 4; ++i)
    s.c.push_back(dice.chance(0.3) ? 1.0 : dice.decades(0.1, 10.0));
  s.c.push_back(dice.chance(0.2) ? 0.0 : 1.0);
  const double size = dice.decades(0.1, 3.1);
  s.generic(dice, size, dice.chance(0.5) ? 0.0 : 1.0);
  s.may_rest = s.c[4] > 0.0;
  s.longest = 50.0;
  s.say("m %.3g %.3g, l %.3g %.3g, g %.3g, angles to %.3g", s.c[0], s.c[1], s.c[2], s.c[3], s.c[4], size);
}

void well(Dice& dice, Draft& s) {
  s.size(dice.whole(1, 5));
  s.formula = Formula::well;
  s.masses(dice, s.n);
  s.k = {dice.whole(0, 7)};
  const double width = dice.decades(0.01, 100.0), size = dice.chance(0.1) ? 0.0 : dice.decades(1e-6, 3.0);
  s.c.push_back(width);
  s.generic(dice, size * width, 0.0);
  if (dice.chance(0.3))
    for (int i = 0; i < s.n; ++i)
      s.p[i] = std::sqrt(s.c[i]) * size * dice.between(-1.0, 1.0);
  for (int i = 0; i < s.n; ++i)
    s.q_scale[i] = width * (size > 0.0 ? size : 1.0),
    s.p_scale[i] = std::sqrt(s.c[i]) * (size > 0.0 ? size : 1.0);
  s.time = 6.0 * width, s.longest = 100.0;
  s.say("kind %d, width %.3g, from %.3g widths", s.k[0], width, size);
}

void wall(Dice& dice, Draft& s) {
  s.size(dice.whole(1, 3));
  s.formula = Formula::wall;
  s.k = {dice.whole(0, 2)};
  s.c = {dice.decades(0.1, 100.0), dice.between(-0.7, 0.7), dice.decades(0.003, 0.5), dice.decades(0.3, 3.0)};
  s.generic(dice, 1.0, 1.0);
  s.q[0] = dice.chance(0.5) ? 1.0 : -1.0;
  s.reach = 30.0 * s.c[2];
  s.longest = 30.0;
  s.say("kind %d, height %.3g at %.3g, width %.3g", s.k[0], s.c[0], s.c[1], s.c[2]);
}

void driven(Dice& dice, Draft& s) {
  s.size(2);
  s.formula = Formula::driven;
  s.k = {dice.whole(0, 2)};
  s.c = {dice.decades(0.01, 1.0), dice.decades(0.1, 30.0)};
  s.generic(dice, 1.0, 1.0);
  s.q[1] = 0.0;
  if (dice.chance(0.5)) s.p[1] = 0.0;
  s.longest = 50.0;
  s.say("kind %d, strength %.3g, frequency %.3g", s.k[0], s.c[0], s.c[1]);
}

void odd(Dice& dice, Draft& s) {
  s.k = {dice.whole(0, 7)};
  s.size(s.k[0] == 7 ? 2 : 1);
  s.formula = Formula::odd;
  s.c = {s.k[0] == 7 ? 0.3 : dice.decades(0.1, 3.0)};
  s.generic(dice, 1.0, s.k[0] == 3 ? 0.5 : 1.0);
  if (s.k[0] == 5) s.longest = 1.0;
  s.may_rest = s.k[0] != 5;
  s.say("kind %d, parameter %.3g", s.k[0], s.c[0]);
}

}  // namespace hostile::families
