#include <avi/solve.hpp>

#include <cmath>
#include <cstdio>

// Events are zeros of a function of the state. q . p rises through zero at pericentre and falls through it at
// apocentre; the third apocentre ends the run, whose price follows the time until then and not t_end.

constexpr auto kepler = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(q[0] * q[0] + q[1] * q[1]);
};

int main() {
  const avi::State<2> start{.q = {0.1, 0.0}, .p = {0.0, std::sqrt(19.0)}};  // pericentre, eccentricity 0.9
  const auto radial = [](const auto& q, const auto& p) { return q[0] * p[0] + q[1] * p[1]; };
  const auto orbit = avi::solve(kepler, start, 1e6, 1e-10,
                                {.events = {avi::when(radial, {.direction = 1}),
                                            avi::when(radial, {.direction = -1, .count = 3, .stop = true})}});
  for (const auto& [index, z] : orbit.events)
    std::printf("%s at %.6f periods, r = %.6f\n", index == 0 ? "pericentre" : "apocentre ",
                z.t / (2.0 * M_PI), z.q.norm());
  std::printf("the run ended at %.6f periods\n", orbit.state.t / (2.0 * M_PI));
}
