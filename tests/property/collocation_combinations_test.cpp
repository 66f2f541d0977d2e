#include "avi/collocation/collocation.hpp"
#include "property/combinations.hpp"

#include <gtest/gtest.h>

// See combinations.hpp.

namespace collocation_combinations_test {

using namespace combinations;

TEST(CollocationCombinations, AutonomousProblems) {
  const auto check_one = [](const char* name, const auto& problem, const auto& from) {
    check(name, avi::collocation<8>(problem, 6), from, 0.2, 1e-5);
  };
  check_one("no monitor", avi::poincare(Quartic{}, start), start);
  check_one("g(q)", avi::poincare(Quartic{}, start, of_q), start);
  check_one("g(q, p)", avi::poincare(Quartic{}, start, of_qp), start);
  const State<avi::dynamic> same{.q = start.q, .p = start.p, .t = start.t};
  check_one("run-time dimension, g(q, p)", avi::poincare(QuarticOf<avi::dynamic>{}, same, of_qp), same);
}

TEST(CollocationCombinations, ProblemsInTime) {
  const auto check_one = [](const char* name, const auto& problem) {
    check(name, avi::collocation<8>(problem, 6), extended(problem, start), 0.2, 1e-5);
  };
  check_one("no monitor", avi::time_dependent(QuarticInTime{}, start));
  check_one("g(q)", avi::time_dependent(QuarticInTime{}, start, of_q));
  check_one("g(q, p)", avi::time_dependent(QuarticInTime{}, start, of_qp));
  check_one("g(q, t, p)", avi::time_dependent(QuarticInTime{}, start, of_qtp));
}

}  // namespace collocation_combinations_test
