#include "avi/avi.hpp"
#include "common/methods/printed_htvi.hpp"
#include "framework/step_defects.hpp"

#include <gtest/gtest.h>

using avi::Kepler, avi::State;

namespace htvi_symplecticity_test {

const Kepler kepler;

/// Defect of one step as a map of (q, p), beside kepler_defect of (q, t, p, p^t): p^t is a variable like the
/// others.
template <class Construction, class G>
double defect(const G& monitor, double h) {
  const State<2> z = experiment::kepler_point();
  return avi::symplecticity_defect(
      avi::type2<3, Construction>(avi::poincare<2>(kepler, z, monitor), avi::simpson()), z, h);
}

// The differences that measure it are good to about 1e-12; a method of order 4 that is not symplectic shows
// 1e-7 here.
constexpr double round_off = 2e-11;

const auto gamma_monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
const auto energy_monitor = avi::bounded(avi::Energy{kepler, 0.5}, 1e-4, 2.0);

template <class Construction>
void expect_symplectic(const auto&... monitor) {
  for (double h : {0.1, 0.05})
    for (const double off :
         {defect<Construction>(monitor, h)..., experiment::kepler_defect<Construction>(monitor, h)...})
      EXPECT_LT(off, round_off) << h;
}

TEST(TypeII, PrintedConstructionIsSymplecticInBothForms) {
  expect_symplectic<experiment::Printed>(gamma_monitor, energy_monitor);
}
TEST(TypeII, AuthorsConstructionIsSymplecticInBothForms) {
  expect_symplectic<experiment::Authors>(gamma_monitor, energy_monitor);
}
TEST(TypeII, StationaryConstructionIsSymplecticInBothForms) {
  expect_symplectic<avi::Stationary>(gamma_monitor, energy_monitor, avi::Unit{});
}

TEST(TypeII, ConservesAngularMomentumToRoundOff) {
  auto z = Kepler::pericentre(0.9);
  const double momentum = Kepler::angular_momentum(z);
  auto method =
      avi::type2<3, experiment::Authors>(avi::poincare<2>(kepler, z, gamma_monitor), avi::simpson());
  double worst = 0.0;
  const auto run = avi::integrate(method, z, 0.1, {.time = 100.0}, [&](const State<2>& s, long) {
    worst = std::max(worst, std::abs(Kepler::angular_momentum(s) - momentum));
  });
  EXPECT_EQ(run.outcome, avi::Outcome::ok);
  EXPECT_LT(worst, 2e-14);
}

}  // namespace htvi_symplecticity_test
