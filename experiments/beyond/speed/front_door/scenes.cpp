#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/pendulum.hpp"
#include "beyond/speed/front_door/contest.hpp"
#include "beyond/speed/front_door/formulas.hpp"
#include "beyond/speed/work_precision/scenes/bodies.hpp"
#include "common/problems/outer_solar_system.hpp"
#include "common/reference.hpp"

#include <fmt/format.h>

namespace experiment::front_door {
namespace {

const std::vector<double> up_to_a_thousand{1.0, 10.0, 100.0, 1000.0};

Scene kepler(double e) {
  const avi::State<2> start = avi::Kepler::pericentre(e);
  return {fmt::format("kepler_{:g}", e), "one body", false, 2.0 * M_PI, up_to_a_thousand, [=](double span) {
            return contest(Kepler<2>{}, start, span,
                           Eigen::VectorXd(work_precision::exact_kepler(start, span)));
          }};
}

/// A scene whose reference has steps of `h`.
template <class P>
Scene scene(const char* name, const char* kind, bool held_out, double unit, std::vector<double> horizons,
            const P& problem, const avi::State<P::dimension>& start, double h) {
  return {name, kind, held_out, unit, std::move(horizons), [=](double span) {
            return contest(problem, start, span, h);
          }};
}

/// Its encounters are too close for fixed steps in time: the reference takes those of the logarithmic
/// Hamiltonian.
Scene seven_bodies() {
  return {"seven_bodies", "bodies", false, 1.0, {1.0}, [](double span) {
            const avi::State<14> start = work_precision::star_cluster_start();
            work_precision::ExtendedRun<work_precision::UnitBodies<7>> reference({}, start, true, 0.005L);
            reference.run_to(span);
            return contest(UnitBodies<7>{}, start, span, Eigen::VectorXd(reference.position(span)));
          }};
}

Planets<6> planets() {
  Planets<6> made{{}, OuterSolarSystem::gravity};
  for (int i = 0; i < 6; ++i)
    made.mass[static_cast<std::size_t>(i)] = OuterSolarSystem::problem().masses()[i] / made.gravity;
  return made;
}

/// The start with momenta in solar masses, as the problem above has them.
avi::State<18> planets_start() {
  avi::State<18> z = OuterSolarSystem::start();
  z.p /= OuterSolarSystem::gravity;
  return z;
}

/// The lowest mode of the chain with its ends held.
template <int masses>
avi::State<masses> lowest_mode(double amplitude) {
  avi::State<masses> z;
  for (int i = 0; i < masses; ++i)
    z.q[i] = amplitude * std::sin(M_PI * (i + 1) / (masses + 1)), z.p[i] = 0.0;
  return z;
}

/// A close pair with e = 0.5 and a third body around it, at rest as a whole.
constexpr std::array triple_masses{1.0, 0.5, 0.3};
avi::State<9> triple() {
  avi::State<9> z;
  z.q << 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 10.0, 0.0, 1.0;
  z.p << 0.0, 0.0, 0.0, 0.0, 2.1, 0.0, 0.0, 0.9, 0.0;  // velocities
  avi::Vector<double, 3> drift = avi::Vector<double, 3>::Zero();
  for (int i = 0; i < 3; ++i)
    drift += triple_masses[static_cast<std::size_t>(i)] / 1.8 * z.p.segment<3>(3 * i);
  for (int i = 0; i < 3; ++i)
    z.p.segment<3>(3 * i) = triple_masses[static_cast<std::size_t>(i)] * (z.p.segment<3>(3 * i) - drift);
  return z;
}

}  // namespace

std::vector<Scene> scenes() {
  constexpr bool seen = false, held_out = true;
  const std::vector<double> up_to_a_hundred{1.0, 10.0, 100.0};
  return {
      kepler(0.0),
      kepler(0.5),
      kepler(0.9),
      scene("henon_heiles", "potential", seen, 2.0 * M_PI, up_to_a_thousand, HenonHeiles{},
            avi::HenonHeiles::on_section(1.0 / 12.0, 0.1, 0.0), 0.5),
      scene("pendulum", "pendulum", seen, avi::Pendulum::period(2.0), up_to_a_thousand, Pendulum{},
            avi::Pendulum::start(2.0), 0.5),
      scene("figure_eight", "bodies", seen, avi::FigureEight::period, up_to_a_hundred, UnitBodies<3>{},
            avi::FigureEight::start(), 0.02),
      seven_bodies(),
      scene("outer_planets", "planets", seen, 4332.0, up_to_a_hundred, planets(), planets_start(), 200.0),
      scene("fput_16", "chain", seen, 2.0 * M_PI, up_to_a_thousand, Fput<16>{}, lowest_mode<16>(1.0), 0.5),
      // at the equator, where the field is 1, with a velocity across and along the field
      scene("dipole", "not separable", seen, 2.0 * M_PI, up_to_a_thousand, Dipole{},
            {.q = {1.0, 0.0, 0.0}, .p = {0.0, 1.08, 0.03}}, 0.2),
      // a planet of the Sun on an inclined orbit, in astronomical units and years
      scene("planet", "one body", held_out, 0.445, up_to_a_thousand, Kepler<3>{4.0 * M_PI * M_PI},
            {.q = {0.6, 0.5, 0.2}, .p = {-4.5, 3.0, 1.0}}, 0.01),
      scene("flattened", "one body", held_out, 2.0 * M_PI, up_to_a_thousand, Flattened{},
            avi::Kepler::pericentre(0.6), 0.06),
      scene("double_pendulum", "pendulum", held_out, 8.2, up_to_a_thousand, DoublePendulum{},
            {.q = {0.6, 0.3}, .p = {0.0, 0.0}}, 0.25),
      scene("galaxy", "potential", held_out, 2.0 * M_PI, up_to_a_thousand, Galaxy{},
            {.q = {1.0, 0.0}, .p = {0.1, 0.7}}, 0.1),
      scene("morse", "potential", held_out, 3.6, up_to_a_thousand, Morse{},
            {.q = {0.0, 1.3}, .p = {0.3, -0.2}}, 0.2),
      scene("restricted", "not separable", held_out, 2.0, up_to_a_thousand, Restricted{},
            {.q = {0.5, 0.0}, .p = {0.0, 1.3}}, 0.03),
      scene("relativistic", "not separable", held_out, 2.0 * M_PI, up_to_a_thousand, Relativistic{},
            {.q = {1.5, 0.5}, .p = {0.2, 1.0}}, 0.25),
      scene("triple", "bodies", held_out, 5.1, up_to_a_hundred, Planets<3>{triple_masses, 1.0}, triple(),
            0.05),
      scene("toda_32", "chain", held_out, 2.0 * M_PI, up_to_a_hundred, Toda<32>{}, lowest_mode<32>(2.0), 0.5),
      scene("shaken", "driven", held_out, 2.0 * M_PI, up_to_a_thousand, Shaken{},
            {.q = {1.0, 0.0}, .p = {0.0, 0.0}}, 0.25),
  };
}

}  // namespace experiment::front_door
