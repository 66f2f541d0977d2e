#include "avi/autodiff/recorded.hpp"
#include "beyond/speed/automatic_monitors/terms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace terms_test {

using avi::ExpressionGraph;
using avi::Recorded;
using experiment::Terms;

/// A formula of two inputs and its terms.
class Formula {
 public:
  template <class F>
  explicit Formula(const F& f)
      : graph_(2), node_(f(Recorded(graph_, 0), Recorded(graph_, 1)).node_in(graph_)) {
    terms_ = Terms::of(graph_, node_);
  }
  [[nodiscard]] std::size_t size() const { return terms_.size(); }
  [[nodiscard]] double value(double x, double y) const {
    return values(x, y)[static_cast<std::size_t>(node_)];
  }
  [[nodiscard]] double sum(double x, double y) const {
    const std::vector<double> all = values(x, y);
    double sum = 0.0;
    for (const Terms::Term& term : terms_)
      sum += term.factor * all[static_cast<std::size_t>(term.node)];
    return sum;
  }

 private:
  [[nodiscard]] std::vector<double> values(double x, double y) const {
    std::vector<double> all;
    for (int i = 0; i < graph_.size(); ++i) {
      const ExpressionGraph::Node& what = graph_[i];
      const auto at = [&](int node) { return node < 0 ? 0.0 : all[static_cast<std::size_t>(node)]; };
      all.push_back(what.operation == avi::Operation::input ? (what.a == 0 ? x : y)
                    : what.operation == avi::Operation::constant
                        ? what.number
                        : avi::detail::evaluate(what.operation, at(what.a), at(what.b)));
    }
    return all;
  }
  ExpressionGraph graph_;
  int node_;
  std::vector<Terms::Term> terms_;
};

TEST(Terms, MultiplyOutAndAreEqualToTheFormulaButForItsNumbers) {
  const Formula morse([](const Recorded& x, const Recorded&) {
    const Recorded e = 1.0 - exp(-x);
    return e * e + 0.5 * (x * x);
  });
  EXPECT_EQ(morse.size(), 3u);  // -2 exp(-x), exp(-x)^2, x^2
  EXPECT_NEAR(morse.sum(0.7, 0.0), morse.value(0.7, 0.0) - 1.0, 1e-15);

  const Formula well([](const Recorded& x, const Recorded& y) {
    const Recorded s = x * x - 1.0;
    return (s * s + y * y) / (2.0 + x * x);
  });
  EXPECT_EQ(well.size(), 4u);  // x^4, -2 x^2, 1 and y^2, each over 2 + x^2
  EXPECT_NEAR(well.sum(0.7, 0.3), well.value(0.7, 0.3), 1e-15);
}

TEST(Terms, KeepDifferencesOfCoordinatesTogether) {
  const Formula spring([](const Recorded& x, const Recorded& y) {
    const Recorded d = x - y;
    return 0.5 * (d * d) + d * d * d;
  });
  EXPECT_EQ(spring.size(), 2u);
  const auto square = [](const auto& sum) {
    return Formula([&](const Recorded& x, const Recorded& y) {
             const Recorded s = sum(x, y);
             return s * s;
           })
        .size();
  };
  EXPECT_EQ(square([](auto x, auto y) { return 2.0 * (x - y) + y / 3.0 + x * 0.5; }), 1u) << "first degree";
  EXPECT_EQ(square([](auto x, auto y) { return x * y + 1.0; }), 2u) << "(x y)^2, 2 x y and a number";
  EXPECT_EQ(square([](auto x, auto y) { return x / y + 1.0; }), 2u);
  EXPECT_EQ(square([](auto x, auto y) { return 1.0 / y - x; }), 3u);
  EXPECT_EQ(square([](auto x, auto) { return sin(x) + 1.0; }), 2u);
  EXPECT_EQ(square([](auto x, auto y) { return x * x - y; }), 3u);
}

TEST(Terms, StayAProductWhereTheyWouldBeMoreThan64) {
  const auto product = [](int left, int right) {
    return Formula([=](const Recorded& x, const Recorded& y) {
      Recorded a = sin(x), b = cos(y);
      for (int k = 2; k <= left; ++k)
        a = a + sin(static_cast<double>(k) * x);
      for (int k = 2; k <= right; ++k)
        b = b + cos(static_cast<double>(k) * y);
      return a * b;
    });
  };
  EXPECT_EQ(product(8, 8).size(), 64u);
  EXPECT_NEAR(product(8, 8).sum(0.3, 0.4), product(8, 8).value(0.3, 0.4), 1e-13);
  EXPECT_EQ(product(5, 13).size(), 1u);
}

TEST(Terms, OfASumThatDoublesManyTimesAreFoundAtOnce) {
  // Without memory each of forty doublings would be taken apart twice; and too many products stay one term.
  const Formula deep([](const Recorded& x, const Recorded& y) {
    Recorded s = x * x + y;
    for (int k = 0; k < 40; ++k)
      s = s + s;
    return s;
  });
  EXPECT_EQ(deep.size(), 2u);
  EXPECT_NEAR(deep.sum(0.5, 0.25), deep.value(0.5, 0.25), 1e-3);
  const Formula wide([](const Recorded& x, const Recorded& y) {
    Recorded s = x * x + y, product = 1.0;
    for (int k = 0; k < 12; ++k)
      product = product * (s + sin(static_cast<double>(k + 1) * x));
    return product;
  });
  EXPECT_LE(wide.size(), 64u);
  EXPECT_NEAR(wide.sum(0.5, 0.25), wide.value(0.5, 0.25), 1e-12);
}

}  // namespace terms_test
