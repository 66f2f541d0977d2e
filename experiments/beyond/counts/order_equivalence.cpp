#include "bregman/table.hpp"

// The Adaptive approach (p, p_ring) compared with the Direct approach of order P = p^2/p_ring at the same
// fictive step. With the exact clock they are the same method; only Euler's clock makes a difference.

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"p", "p_ring", "order", "h", "clock", "adaptive_iterations",
                              "direct_iterations", "distance_100", "distance_1000", "converged"});
  table.note("distance_n", "largest |x_adaptive - x_direct| / |x_direct| over the first n iterations");
  const CorrelatedQuartic f;
  const avi::Stopping stopping{.delta = 1e-10, .iterations = 200'000};
  for (Setting s : p_dependence_settings()) {
    const Setting single = direct("htvi", s.family().order(), s.h);
    const auto reference = run_setting(single, f, f.start(), stopping);
    std::vector<avi::VectorX> path;
    run_setting(single, f, f.start(), {.delta = 0.0, .iterations = 1000},
                [&](const avi::Iterate& at, long, long) { path.push_back(at.x); });
    for (const auto clock : {avi::Clock::exact, avi::Clock::euler}) {
      s.clock = clock;
      double distance[2] = {0.0, 0.0};
      run_setting(s, f, f.start(), {.delta = 0.0, .iterations = 1000},
                  [&](const avi::Iterate& at, long k, long) {
                    const auto& x = path[static_cast<std::size_t>(k)];
                    const double apart = (at.x - x).norm() / x.norm();
                    if (k <= 100) distance[0] = std::max(distance[0], apart);
                    distance[1] = std::max(distance[1], apart);
                  });
      const auto result = run_setting(s, f, f.start(), stopping);
      const bool is_exact = clock == avi::Clock::exact;
      table.row(s.p, s.p_ring, s.family().order(), s.h, is_exact ? "exact" : "euler", result.iterations,
                reference.iterations, distance[0], distance[1], result.ok() && reference.ok());
    }
  }
}
