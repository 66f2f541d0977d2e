#include "hostile/draft.hpp"

#include <iterator>

namespace hostile {

namespace {

struct Named {
  const char* name;
  families::Family* family;
  int share;  // of the draws
};
constexpr Named all_families[] = {{"anharmonic", families::anharmonic, 4},
                                  {"henon", families::henon, 2},
                                  {"springs", families::springs, 6},
                                  {"pendula", families::pendula, 5},
                                  {"charge", families::charge, 5},
                                  {"bodies", families::bodies, 9},
                                  {"relativistic", families::relativistic, 5},
                                  {"metric", families::metric, 4},
                                  {"surface", families::surface, 4},
                                  {"toda", families::toda, 3},
                                  {"morse", families::morse, 3},
                                  {"growth", families::growth, 4},
                                  {"lennard-jones", families::lennard_jones, 4},
                                  {"repulsion", families::repulsion, 4},
                                  {"dense", families::dense, 4},
                                  {"chain", families::chain, 4},
                                  {"double pendulum", families::double_pendulum, 3},
                                  {"well", families::well, 5},
                                  {"wall", families::wall, 4},
                                  {"scattering", families::scattering, 4},
                                  {"driven", families::driven, 3},
                                  {"three-body", families::three_body, 3},
                                  {"kepler", families::kepler, 5},
                                  {"odd", families::odd, 4},
                                  {"top", families::top, 2}};

/// At rest, symmetric, or with entries that are zero.
void special_start(Dice& dice, Draft& s) {
  if (s.own_start) return;
  const double which = dice.between(0.0, 1.0);
  if (which < 0.12 && s.may_rest) {
    std::fill(s.p.begin(), s.p.end(), 0.0);
    s.note += ", at rest";
  } else if (which < 0.2) {
    for (int i = 0; i < s.n; ++i)
      if (dice.chance(0.5) && s.may_rest) s.p[i] = 0.0;
    s.note += ", some at rest";
  } else if (which < 0.26 && s.n > 1 && s.may_be_alike()) {
    std::fill(s.q.begin(), s.q.end(), s.q[0]), std::fill(s.p.begin(), s.p.end(), s.p[0]);
    s.note += ", all alike";
  }
}

/// Units over sixty decades, for H, time and each coordinate.
void units(Dice& dice, Draft& s) {
  double length = 1.0, mass = 1.0, time = 1.0;
  if (dice.chance(0.5)) {
    length = dice.decades(1e-30, 1e30), mass = dice.decades(1e-30, 1e30), time = dice.decades(1e-30, 1e30);
    s.say("; units %.1e %.1e %.1e", length, mass, time);
  }
  s.unit.assign(s.n, length);
  s.action = mass * length * length / time;
  s.energy = s.action / time;
  if (dice.chance(0.1)) {
    for (double& unit : s.unit)
      unit *= dice.decades(1e-3, 1e3);
    s.note += "; a unit for each coordinate";
  }
  for (int i = 0; i < s.n; ++i) {
    s.q[i] *= s.unit[i], s.p[i] *= s.action / s.unit[i];
    s.q_scale[i] *= s.unit[i], s.p_scale[i] *= s.action / s.unit[i];
  }
  s.t *= time, s.t_end *= time;
}

}  // namespace

System draw(std::uint64_t seed, int index, double longest) {
  Dice dice(seed, static_cast<std::uint64_t>(index));
  int shares = 0;
  for (const Named& each : all_families)
    shares += each.share;
  int ticket = dice.whole(0, shares - 1);
  const Named* chosen = std::begin(all_families);
  for (; ticket >= chosen->share; ++chosen)
    ticket -= chosen->share;
  Draft s;
  s.family = chosen->name;
  chosen->family(dice, s);
  special_start(dice, s);
  const double times = std::min({dice.decades(0.3, 300.0), std::max(s.longest, 0.3), longest});
  if (dice.chance(0.1)) s.t = dice.between(-10.0, 10.0) * s.time;
  s.t_end = s.t + times * s.time;
  s.say("; %.3g times %.3g", times, s.time);
  units(dice, s);
  return s;
}

}  // namespace hostile
