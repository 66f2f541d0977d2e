#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/transform/poincare.hpp"
#include "beyond/speed/cost_growth/axes.hpp"
#include "common/problems/chain.hpp"

#include <memory>

// Cost and dimension: chains of increasing length, by collocation of order 16. All operations act on the
// eight stages of a step at once.

namespace experiment {
namespace {

using avi::dynamic;
constexpr int stages = 8;
constexpr double step_size = 0.5;
using Stage = avi::Pack<stages>;
using Vec = avi::Vector<Stage, dynamic>;

/// A measurement that repeats a piece of work.
Measurement repeated(long repeats, const auto& work) {
  const auto run = [=] {
    for (long k = 0; k < repeats; ++k)
      work();
  };
  return {.run = run, .units = static_cast<double>(repeats)};
}

/// The value of H, the unit of cost.
Measurement value(const avi::State<dynamic>& z, long repeats) {
  const Vec q = z.q.cast<Stage>(), p = z.p.cast<Stage>();
  const auto sum = std::make_shared<Stage>(0.0);
  return repeated(repeats, [=] { *sum += Chain{}(q, p); });
}

/// Both halves of the gradient of H, by automatic differentiation.
Measurement gradient(const avi::State<dynamic>& z, long repeats) {
  const auto program = std::make_shared<avi::Program>(avi::record(Chain{}, z.q.size()).gradient());
  const auto room = std::make_shared<avi::Program::Room<Stage>>(*program);
  for (Eigen::Index i = 0; i < z.q.size(); ++i) {
    room->arguments()[i] = z.q[i];
    room->arguments()[z.q.size() + i] = z.p[i];
  }
  return repeated(repeats, [=] { program->run(*room); });
}

/// A sweep: the time of a run divided by its number of sweeps.
template <class H, int n>
Measurement sweep(const H& hamiltonian, const avi::State<n>& z, long steps) {
  using Method = avi::Collocation<avi::Poincare<n, H>>;
  const auto method = std::make_shared<Method>(avi::poincare(hamiltonian, z), 2 * stages);
  const auto run = [=] {
    avi::State<n> moved = z;
    return avi::integrate(*method, moved, step_size, {.steps = steps});
  };
  const avi::Run done = run();
  return {.steps = done.steps, .run = [=] { (void)run(); }, .units = static_cast<double>(done.evaluations)};
}

}  // namespace

Axis along_dimension(bool quick) {
  Axis axis{"dimension"};
  const auto add = [&](const char* subject, int n, Measurement made) {
    made.subject = subject;
    made.value = n;
    axis.runs.push_back(std::move(made));
  };
  for (int n = 2; n <= 512; n *= quick ? 16 : 2) {
    const auto z = Chain::plucked(n);
    const long repeats = 40'000 / n;
    add("energy", n, value(z, repeats));
    add("gradient", n, gradient(z, repeats));
    const long steps = std::max(repeats / 200, 10L);
    add("sweep", n, sweep(avi::Automatic{Chain{}}, z, steps));
    if (n == 32)
      add("sweep, supplied gradient", n, sweep(Chain{}, avi::State<32>{.q = z.q, .p = z.p}, steps));
  }
  for (const char* subject : {"energy", "gradient", "sweep"})
    axis.expected.push_back({subject, unknown, 1.0, 1e3});
  return axis;
}

}  // namespace experiment
