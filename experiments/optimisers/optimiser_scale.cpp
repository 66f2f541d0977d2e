#include "avi/optim/minimise.hpp"
#include "avi/optim/sweep.hpp"
#include "common/frame.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/timing.hpp"

#include <malloc.h>

// What an iteration of avi::minimise() costs beside the objective: at d = 50 against an evaluation of the
// paper's quartic, at large d against the vectors that it has to read and to write, at the speed at which
// loops of the same program do nothing else.

namespace {

using namespace experiment;
using avi::VectorX;

/// sum_i c_i x_i^2 / 2 with a thousand eigenvalues between 1 and 100; its own time is kept apart.
struct Quadratic {
  mutable double spent = 0.0;
  double operator()(const VectorX& x, VectorX& g) const {
    double f = 0.0;
    spent += seconds([&] {
      double ramp = 1.0;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        g[i] = ramp * x[i];
        f += 0.5 * g[i] * x[i];
        ramp = ramp < 100.0 ? ramp + 0.1 : 1.0;
      }
    });
    return f;
  }
};

/// Seconds to read one vector of n entries, and to read and write it in place, each over eight vectors that
/// the next use finds outside the cache, as an iteration does.
struct Stream {
  double read, update;

  explicit Stream(Eigen::Index n) {
    std::vector<VectorX> v(8, VectorX::Ones(n));
    double total = 0.0;
    const auto least = interleaved_least_seconds(
        {[&] {
           for (std::size_t k = 0; k < 8; k += 4)
             total += avi::sweep<1>(n, [a = v[k].data(), b = v[k + 1].data(), c = v[k + 2].data(),
                                        d = v[k + 3].data()](auto at, auto& sum) {
               sum[0] += at(a) * at(b) + at(c) * at(d);
             })[0];
         },
         [&] {
           for (VectorX& x : v)
             avi::sweep<0>(n, [out = x.data()](auto at, auto&) { at.set(out, at(out) * 0.0 + 1.0); });
         }},
        5);
    read = total > 0.0 ? least[0] / 8.0 : 0.0;  // the sum is used
    update = least[1] / 8.0;
  }
};

struct Cost {
  double iteration = 0.0;    ///< Seconds of one, the objective left out.
  double evaluation = 0.0;   ///< Seconds of one.
  double evaluations = 0.0;  ///< Evaluations of an iteration.
  double vectors = 0.0;      ///< Memory in units of x, without the caller's x0.
};

double in_use() { return static_cast<double>(mallinfo2().uordblks); }

/// The quicker of twice seven iterations after the first eight, by which all pairs are there; the masses are
/// learned once in seven. All ends are taken in the callback: the run's memory is given back after the last.
Cost at_scale(Eigen::Index n, int memory) {
  constexpr long first = 8, count = 7;
  const Quadratic f;
  VectorX x0(n);
  for (Eigen::Index i = 0; i < n; ++i)
    x0[i] = 1.0 + static_cast<double>(i % 7);
  const double before = in_use();
  Cost cost{.iteration = 1e9, .evaluation = 1e9};
  double began = 0.0, spent = 0.0, evaluations = 0.0;
  const Stopwatch clock;
  const auto look = [&](const avi::Progress& at) {
    if (at.iterations < first || (at.iterations - first) % count != 0) return true;
    const double now = clock(), made = at.gradient_evaluations - evaluations;
    if (at.iterations == first) {
      cost.vectors = (in_use() - before) / (8.0 * n);
    } else {
      cost.iteration = std::min(cost.iteration, (now - began - (f.spent - spent)) / count);
      cost.evaluation = std::min(cost.evaluation, (f.spent - spent) / made);
      cost.evaluations = made / count;
    }
    began = clock(), spent = f.spent, evaluations += made;
    return true;
  };
  (void)avi::minimise(f, x0,
                      {.relative = 0.0, .memory = memory, .iterations = first + 2 * count, .callback = look});
  return cost;
}

/// The paper's quartic to 1e-10, again and again.
Cost small(int memory) {
  const CorrelatedQuartic f;
  const avi::MinimiseOptions options{.relative = 0.0, .absolute = 1e-10, .change = 1e-10, .memory = memory};
  VectorX x = f.start(), g(f.size());
  avi::Minimisation run;
  const auto evaluate = [&] {
    for (int k = 0; k < 200; ++k)
      x[0] += 1e-30 * f(x, g);
  };
  const auto minimise = [&] { run = avi::minimise(f, f.start(), options); };
  const auto least = interleaved_least_seconds({evaluate, minimise}, 40);
  const double count = run.iterations, made = run.gradient_evaluations, evaluation = least[0] / 200.0;
  return {(least[1] - made * evaluation) / count, evaluation, made / count, 0.0};
}

}  // namespace

void experiment::conduct(Frame& frame) {
  // Memory that was given back is used again: fresh pages take the system longer than what is measured.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  Table& table =
      frame.table({"objective", "dimension", "memory", "evaluation_seconds", "own_seconds",
                   "evaluations_per_iteration", "own_in_evaluations", "vectors_read", "vectors_written",
                   "read_seconds", "update_seconds", "own_over_needed", "peak_vectors"});
  table.note("own_seconds",
             "of one iteration, the objective left out; the least of twice seven, of forty rounds at d = 50");
  table.note("update_seconds", "to read a vector and write it in place; read_seconds: to read it");
  table.note("own_over_needed", "own_seconds over the time to read and write the vectors that an iteration "
                                "needs, by loops that do nothing else");
  table.note("peak_vectors", "memory of a run in units of x, the caller's x0 left out");
  for (int memory : {0, 7}) {
    frame.progress("d = 50", 0.0);
    const Cost cost = small(memory);
    table.row("quartic", 50, memory, cost.evaluation, cost.iteration, cost.evaluations,
              cost.iteration / cost.evaluation, unknown, unknown, unknown, unknown, unknown, unknown);
  }
  for (double n : {1e5, 1e7}) {
    if (frame.quick && n > 1e6) continue;
    const auto size = static_cast<Eigen::Index>(n);
    const Stream stream(size);
    for (int memory : {0, 7}) {
      frame.progress("large d", 0.5);
      const Cost cost = at_scale(size, memory);
      // trial: x, d, out; products with d: g, d; next point: x, g, g_t, d, out: x, g and a pair; next
      // d: g, d, out; or twice the pairs and g, out: d; masses: twice a pair and they, out: they
      const double read = memory == 0 ? 10.0 : 15.0 + 4.0 * memory, written = memory == 0 ? 4.0 : 7.0;
      const double needed = (read - written) * stream.read + written * stream.update;
      table.row("quadratic", n, memory, cost.evaluation, cost.iteration, cost.evaluations,
                cost.iteration / cost.evaluation, read, written, stream.read, stream.update,
                cost.iteration / needed, n > 1e6 ? cost.vectors : unknown);
    }
  }
}
