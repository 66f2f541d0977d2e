#include <avi/collocation/collocation.hpp>
#include <avi/core/ensemble.hpp>
#include <avi/transform/time_dependent.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

// Chaos near a separatrix: many starts of a pendulum whose gravity is shaken a little. Deep inside it swings
// for ever, far outside it always turns over; between them it does now the one and then the other.

constexpr double omega = 2.0;

struct ShakenPendulum {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S& t, const P& p) const {
    using std::cos;
    return 0.5 * (p[0] * p[0]) - (1.0 + 0.1 * cos(omega * t)) * cos(q[0]);
  }
};

int main() {
  std::vector<avi::State<2>> starts;  // (q, t), (p, p^t)
  for (int i = 0; i < 104; ++i) {
    const avi::State<1> z{.q = avi::Vector<double, 1>(0.0), .p = avi::Vector<double, 1>(0.025 * (i + 0.5))};
    starts.push_back(avi::extended(avi::time_dependent(ShakenPendulum{}, z), z));
  }
  const auto problem = avi::time_dependent(ShakenPendulum{}, avi::reduced(starts[0]));

  std::vector<int> over(starts.size(), 0), back(starts.size(), 0);  // steps beyond the top, turning points
  std::vector<double> before(starts.size(), 1.0);
  const auto members = avi::ensemble([&](const auto&) { return avi::collocation(problem, 12); }, starts, 0.25,
                                     {.time = 40.0}, {},
                                     [&](std::size_t i, const avi::State<2>& z, long) {
                                       over[i] += std::abs(z.q[0]) > M_PI;
                                       back[i] += z.p[0] * before[i] < 0.0;
                                       before[i] = z.p[0];
                                     });
  int ok = 0, swing = 0, turn = 0, both = 0;
  double first = 0.0, last = 0.0;  // momenta of those that do both
  for (std::size_t i = 0; i < members.size(); ++i) {
    ok += members[i].run.outcome == avi::Outcome::ok;
    const bool does_both = over[i] > 0 && back[i] > 0;
    swing += over[i] == 0;
    turn += back[i] == 0;
    both += does_both;
    if (does_both && first == 0.0) first = starts[i].p[0];
    if (does_both) last = starts[i].p[0];
  }
  std::printf("%d of %zu runs ok\n", ok, members.size());
  std::printf("%d swing, %d turn over, %d do both: those that start with p = %.4f to %.4f\n", swing, turn,
              both, first, last);
}
