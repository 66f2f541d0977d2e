#include <avi/core/integrate_to.hpp>
#include <avi/htvi/htvi.hpp>
#include <avi/transform/monitors.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const auto kepler = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - pow(q[0] * q[0] + q[1] * q[1], -0.5);
  };
  const avi::State<2> start{.q = {0.1, 0.0}, .p = {0.0, std::sqrt(19.0)}};  // pericentre, e = 0.9
  const auto problem = avi::poincare<2>(kepler, start, avi::bounded(avi::Gamma{}, 0.01, 8.0));
  auto method = avi::htvi<8>(problem);
  avi::State<2> z = start;
  const avi::Run run = avi::integrate_to(method, z, 0.2, 20.0 * M_PI);  // ten periods
  std::printf("%ld steps, energy changed by %.0e, back at the start to %.0e\n", run.steps,
              std::abs(kepler(z.q, z.p) - kepler(start.q, start.p)), (z.q - start.q).norm());
}
