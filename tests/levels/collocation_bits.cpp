#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"
#include "common/problems/chain.hpp"
#include "common/problems/double_pendulum.hpp"

#include <cstdio>

// Prints where runs of collocation end, every bit of it, for tests/levels.sh: gradients supplied, automatic
// and recorded, packs of 4, 8 and 16 numbers, roots, powers and sines.

namespace {

template <class Problem>
void run(const char* name, const Problem& problem, const avi::State<Problem::dimension>& start, double h) {
  for (const int order : {4, 8, 12, 16, 24}) {
    auto method = avi::collocation<32>(problem, order);
    auto z = start;
    const avi::Run done = avi::integrate(method, z, h, {.steps = 100});
    std::printf("%s\t%d\t%ld\t%a", name, order, done.evaluations, z.t);
    for (Eigen::Index i = 0; i < z.q.size(); ++i)
      std::printf("\t%a\t%a", z.q[i], z.p[i]);
    std::printf("\n");
  }
}

}  // namespace

int main() {
  const auto start = avi::Kepler::pericentre(0.9);
  const avi::Kepler kepler;
  run("supplied", avi::poincare(kepler, start, avi::Gamma{0.75}), start, 0.3);
  run("automatic", avi::poincare(avi::Automatic{kepler}, start, avi::Energy{kepler, 0.5}), start, 0.01);
  const auto pendulum = experiment::DoublePendulum::released(1.2, 0.8);
  run("sines", avi::poincare(experiment::DoublePendulum{}, pendulum), pendulum, 0.3);
  const auto chain = experiment::Chain::plucked(20);
  run("recorded", avi::poincare(experiment::Chain{}, chain), chain, 0.5);
}
