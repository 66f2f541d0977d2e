#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "difference.hpp"

#include <gtest/gtest.h>

#include <string>

using avi::Kepler;
using V = avi::Vector<double, 2>;

namespace monitors_test {

const Kepler kepler;

/// Calls check(name, g) for every monitor, also in bounded form.
template <class Check>
void for_each_monitor(Check check) {
  const auto both = [&](const std::string& name, auto g) {
    check(name, g);
    check("bounded " + name, avi::bounded(g, 0.05, 3.0));
  };
  both("gamma", avi::Gamma{0.7});
  both("norm_squared", avi::NormSquared{});
  both("arclength", avi::Arclength{kepler, -0.5});
  both("energy", avi::Energy{kepler, 0.5});
  both("inverse_lagrangian", avi::Energy{kepler, 0.0});
  both("truncation", avi::Truncation{kepler, 1e-3, 0.1});
  both("truncation_root", avi::Truncation<Kepler, 4>{kepler, 1e-3, 0.1});
}

template <class G>
double at(const G& g, const V& q, const V& p) {
  if constexpr (std::invocable<const G&, const V&>)
    return g(q);
  else
    return g(q, p);
}

template <class G>
V slope(const G& g, const V& q, const V& p) {
  if constexpr (std::invocable<const G&, const V&>)
    return avi::value_and_gradient(g, q).gradient();
  else
    return avi::d_dq(g, q, p);
}

TEST(Monitors, GradientsAgreeWithCentralDifferences) {
  for (const auto& [q, p] : {std::pair{V{0.1, 0.02}, V{-0.4, 4.0}}, std::pair{V{-1.7, 0.3}, V{-0.2, -0.3}}})
    for_each_monitor([&, q = q, p = p](const std::string& name, const auto& g) {
      const V automatic = slope(g, q, p);
      EXPECT_LT(gradient_defect([&](const V& x) { return at(g, x, p); }, q, automatic, 1e-3 * q.norm()),
                2e-8 * std::max(1.0, automatic.norm()))
          << name;
      EXPECT_GT(at(g, q, p), 0.0) << name;
    });
}

TEST(Monitors, TakeTheirDefinedValues) {
  const V q{0.3, 0.4}, p{1.0, 2.0};  // |q| = 1/2, V = -2, |grad V| = 4, T = 5/2
  EXPECT_NEAR(avi::Gamma{0.5}(q), 0.5, 1e-16);
  EXPECT_EQ(avi::Gamma{}(q), avi::NormSquared{}(q));
  EXPECT_NEAR(avi::NormSquared{}(q), 0.25, 1e-16);
  EXPECT_NEAR((avi::Arclength{kepler, -0.5}(q)), 1.0 / std::sqrt(2.0 * 1.5 + 16.0), 1e-16);
  EXPECT_NEAR((avi::Energy{kepler, 0.5}(q, p)), 1.0 / 4.0, 1e-16);
  EXPECT_NEAR((avi::Energy{kepler, 0.0}(q, p)), 1.0 / 4.5, 1e-16);
  EXPECT_NEAR((avi::Truncation{kepler, 1e-3, 0.1}(q)), 1e-3 / (0.005 * 4.0), 1e-16);
  EXPECT_NEAR((avi::Truncation<Kepler, 4>{kepler, 1e-3, 0.1}(q)), std::pow(0.05, 0.25), 1e-15);
}

TEST(Bounded, StaysWithinItsBounds) {
  const auto g = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  EXPECT_NEAR(avi::bounded(avi::NormSquared{}, 1.0, 3.0)(V{1.0, 1.0}), 3.0 * (2.0 + 1.0) / (2.0 + 3.0),
              1e-15);
  EXPECT_NEAR(g(V{0.0, 0.0}), 0.01, 1e-17);
  EXPECT_LT(g(V{1e8, 0.0}), 8.0 + 1e-12);
  EXPECT_GT(g(V{1e8, 0.0}), 7.99);
  EXPECT_NO_THROW(avi::bounded(avi::NormSquared{}, 0.0, 0.5));
}

}  // namespace monitors_test
