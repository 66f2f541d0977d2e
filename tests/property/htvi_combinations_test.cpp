#include "avi/htvi/htvi.hpp"
#include "property/combinations.hpp"

#include <gtest/gtest.h>

// See combinations.hpp.

namespace htvi_combinations_test {

using namespace combinations;

TEST(HtviCombinations, AutonomousProblems) {
  const auto check_one = [](const char* name, const auto& problem) {
    check(name, avi::type2<2>(problem), start, 0.1, 1e-5);
  };
  check_one("no monitor", avi::poincare(Quartic{}, start));
  check_one("g(q)", avi::poincare(Quartic{}, start, of_q));
  check_one("g(q, p)", avi::poincare(Quartic{}, start, of_qp));
  check("type III, g(q, p)", avi::type3<2>(avi::poincare(Quartic{}, start, of_qp)), start, 0.1, 1e-5);
}

TEST(HtviCombinations, ProblemsInTime) {
  const auto check_one = [](const char* name, const auto& problem) {
    check(name, avi::type2<2>(problem), extended(problem, start), 0.1, 1e-5);
  };
  check_one("no monitor", avi::time_dependent(QuarticInTime{}, start));
  check_one("g(q)", avi::time_dependent(QuarticInTime{}, start, of_q));
  check_one("g(q, p)", avi::time_dependent(QuarticInTime{}, start, of_qp));
  check_one("g(q, t, p)", avi::time_dependent(QuarticInTime{}, start, of_qtp));
  const auto problem = avi::time_dependent(QuarticInTime{}, start, of_qtp);
  check("type III, g(q, t, p)", avi::type3<2>(problem), extended(problem, start), 0.1, 1e-5);
}

}  // namespace htvi_combinations_test
