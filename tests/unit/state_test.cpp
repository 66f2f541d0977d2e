#include "avi/core/state.hpp"

#include "avi/avi.hpp"
#include "refusal.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace state_test {

TEST(State, IsFiniteWhereEveryEntryIs) {
  const double big = std::numeric_limits<double>::max(), inf = std::numeric_limits<double>::infinity();
  const auto finite = [](double q, double p, double t) {
    return avi::State<2>{.q = {q, q}, .p = {p, p}, .t = t}.finite();
  };
  EXPECT_TRUE(finite(1.0, 2.0, 3.0));
  EXPECT_TRUE(finite(big, big, 0.0)) << "the sum is not, the entries are";
  EXPECT_FALSE(finite(inf, 0.0, 0.0));
  EXPECT_FALSE(finite(0.0, NAN, 0.0));
  EXPECT_FALSE(finite(0.0, 0.0, -inf));
  EXPECT_FALSE(finite(inf, -inf, 0.0));
}

TEST(State, EqualsWhatHasTheSameNumbers) {
  const avi::State<2> z{.q = {1.0, 2.0}, .p = {3.0, 4.0}, .t = 5.0};
  EXPECT_TRUE(z == z);
  for (int part = 0; part < 3; ++part) {
    avi::State<2> other = z;
    (part == 0 ? other.q[1] : part == 1 ? other.p[1] : other.t) += 1.0;
    EXPECT_FALSE(z == other) << part;
  }
}

TEST(State, IsRefusedWhereItsDimensionIsNone) {
  const auto said = [](int q, int p) {
    const avi::State<avi::dynamic> z{.q = avi::VectorX::Zero(q), .p = avi::VectorX::Zero(p)};
    return refusal([&] { avi::require_dimension(z); });
  };
  EXPECT_EQ(said(1, 1), "accepted");
  EXPECT_EQ(said(0, 0), "Dimension of q at the start is 0; it must be at least 1.");
  EXPECT_EQ(said(2, 3), "Dimension of p at the start is 3; it must be that of q, 2.");
}

TEST(State, TakesBracesInEveryDimension) {
  const avi::State<1> one{.q = {0.5}, .p = {-0.25}};
  EXPECT_EQ(one.q[0], 0.5);
  EXPECT_EQ(one.p[0], -0.25);
  avi::State<1> other{.q = avi::Vector<double, 1>(2.0), .p = 2.0 * one.q + one.p};
  other.q += one.q;
  other.p = one.p;
  const avi::Vector<double, 1> copy = other.q;
  EXPECT_EQ(copy[0], 2.5);
  EXPECT_EQ(other.p[0], -0.25);
  EXPECT_EQ(sizeof(avi::State<1>), 3 * sizeof(double));
  const avi::State<4> four{.q = {1.0, 2.0, 3.0, 4.0}, .p = {5.0, 6.0, 7.0, 8.0}};
  EXPECT_EQ(four.q[3], 4.0);
  // Of a vector of run-time size two whole numbers were its rows and columns.
  const avi::State<avi::dynamic> whole{.q = {2, 1}, .p = {0, 3}};
  ASSERT_EQ(whole.q.size(), 2);
  EXPECT_EQ(whole.q[0], 2.0);
  EXPECT_EQ(whole.q[1], 1.0);
  EXPECT_EQ(whole.p[1], 3.0);
  avi::State<avi::dynamic> later;
  EXPECT_EQ(later.q.size(), 0);
  later.q = {4, 5, 6};
  EXPECT_EQ(later.q[2], 6.0);
}

TEST(State, CountsTheNumbersInBraces) {
  EXPECT_EQ(refusal([] {
              (void)avi::State<3>{.q = {3, 1}};
            }),
            "Number of entries of q or p is 2; it must be 3, the dimension of the State.");
  EXPECT_EQ(refusal([] { (void)avi::State<2>{.q = {3}}; }),
            "Number of entries of q or p is 1; it must be 2, the dimension of the State.");
  avi::State<2> z;
  EXPECT_EQ(refusal([&] {
              z.p = {1.0, 2.0, 3.0};
            }),
            "Number of entries of q or p is 3; it must be 2, the dimension of the State.");
}

TEST(State, CountsTheEntriesOfAVectorWhoseSizeIsKnownAtRunTime) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1), two = Eigen::VectorXd::Ones(2),
                        three = Eigen::VectorXd::Ones(3);
  EXPECT_EQ(refusal([&] { (void)avi::State<2>{.q = one, .p = two}; }),
            "Number of entries of q or p is 1; it must be 2, the dimension of the State.");
  avi::State<2> z{.q = two, .p = 2.0 * three.head(2)};
  EXPECT_EQ(z.p[1], 2.0);
  EXPECT_EQ(refusal([&] { z.q = three; }),
            "Number of entries of q or p is 3; it must be 2, the dimension of the State.");
  z.q = 3.0 * two + z.p;
  EXPECT_EQ(z.q[1], 5.0);
}

TEST(State, IsNotANumberWhereNothingIsGiven) {
  // Whatever was in its memory before.
  alignas(avi::State<2>) unsigned char memory[sizeof(avi::State<2>)];
  std::fill(std::begin(memory), std::end(memory), static_cast<unsigned char>(0x3f));
  const auto* z = new (memory) avi::State<2>;
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(std::isnan(z->q[i]));
    EXPECT_TRUE(std::isnan(z->p[i]));
  }
  EXPECT_EQ(z->t, 0.0);
}

TEST(State, IsRefusedWhereAPartWasForgotten) {
  avi::State<2> z;
  z.q << 1.0, 0.0;
  EXPECT_EQ(refusal([&] { (void)avi::poincare<2>(systems::spring, z); }),
            "At the start p[0] is nan; it must be finite.");
  const avi::State<1> none;
  EXPECT_EQ(refusal([&] { (void)avi::poincare<1>(systems::spring, none); }),
            "At the start q[0] is nan; it must be finite.");
  z.p << 0.0, 1.0;
  auto method = avi::collocation(avi::poincare<2>(systems::spring, z), 4);
  z.p[1] = INFINITY;
  const avi::Run run = avi::integrate(method, z, 0.1, {.steps = 2});
  EXPECT_EQ(run.outcome, avi::Outcome::non_finite);
  EXPECT_EQ(run.message, "The run ended as non_finite after 0 steps, at t = 0: at the start p[1] is inf.");
}

TEST(State, IsNotReadBeyondItsEnd) {
  const avi::State<2> z{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  const auto beyond = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + q[2]; };
  const auto before = [](const auto& q, const auto& p) { return 0.5 * p(-1) * p[0] + q[1]; };
  const std::string sentence =
      "Index of an entry is 2; it must be at least 0 and below 2, the size of the vector.";
  EXPECT_EQ(refusal([&] { (void)avi::poincare<2>(beyond, z); }), sentence);
  EXPECT_EQ(refusal([&] { (void)avi::poincare<2>(before, z); }).find("Index of an entry is -1"), 0u);
  const avi::State<avi::dynamic> same{.q = z.q, .p = z.p};
  EXPECT_EQ(refusal([&] { (void)avi::poincare<avi::dynamic>(beyond, same); }), sentence);
  const auto H = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0] + q[1] * q[1]); };
  const auto monitor = [](const auto& q) { return 1.0 + q[2] * q[2]; };
  EXPECT_EQ(refusal([&] { (void)avi::poincare<2>(H, z, monitor); }), sentence);
  EXPECT_EQ(refusal([&] { (void)avi::record<2>(beyond); }), sentence);
  const auto timed = [](const auto& q, const auto& t, const auto& p) { return 0.5 * p[0] * p[0] + t * q[2]; };
  EXPECT_EQ(refusal([&] { (void)avi::extended(avi::time_dependent(timed, z), z); }), sentence);
}

}  // namespace state_test
