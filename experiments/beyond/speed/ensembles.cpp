#include "common/frame.hpp"
#include "common/timing.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/core/ensemble.hpp"
#include "avi/transform/time_dependent.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

// Many starts of one problem: a pendulum whose gravity is shaken, followed at full turns of the shaking.
// Where the separatrix of the unshaken one was, a layer of chaos lies. And what several threads gain.

namespace {

using namespace experiment;
using avi::State;

constexpr double amplitude = 0.1, omega = 2.0, period = 2.0 * M_PI / omega;

struct ShakenPendulum {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S& t, const P& p) const {
    using std::cos;
    return 0.5 * (p[0] * p[0]) - (1.0 + amplitude * cos(omega * t)) * cos(q[0]);
  }
};

/// Hanging down, with momenta from 0 to 2.6.
std::vector<State<2>> cloud(int members) {
  std::vector<State<2>> starts;
  for (int i = 0; i < members; ++i) {
    const State<1> z{.q = avi::Vector<double, 1>(0.0),
                     .p = avi::Vector<double, 1>(2.6 * (i + 0.5) / members)};
    starts.push_back(avi::extended(avi::time_dependent(ShakenPendulum{}, z), z));
  }
  return starts;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, AVI_SHOWS, [](Frame& frame) {
    const int members = frame.quick ? 8 : 52, order = 16;
    const long turns = frame.quick ? 20 : 300, steps_per_turn = 8;
    const double h = period / steps_per_turn;
    const std::vector<State<2>> starts = cloud(members);
    const auto problem = avi::time_dependent(ShakenPendulum{}, avi::reduced(starts[0]));
    const auto make = [&](const State<2>&) { return avi::collocation(problem, order); };
    const avi::Until until{.steps = turns * steps_per_turn};

    frame.progress("cloud", 0.1);
    std::vector<std::vector<State<2>>> seen(starts.size());
    const auto ends =
        avi::ensemble(make, starts, h, until, {}, [&](std::size_t i, const State<2>& z, long k) {
          if (k % steps_per_turn == 0) seen[i].push_back(z);
        });
    Table section = frame.table({"member", "turn", "angle", "momentum"});
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (std::size_t k = 0; k < seen[i].size(); ++k)
        section.row(i, k + 1, std::remainder(seen[i][k].q[0], 2.0 * M_PI), seen[i][k].p[0]);

    frame.progress("threads", 0.5);
    const auto single = [&] {
      for (State<2> z : starts) {
        auto method = make(z);
        if (avi::integrate(method, z, h, until).outcome != avi::Outcome::ok)
          throw std::runtime_error("A single run of the cloud failed.");
      }
    };
    std::vector<std::function<void()>> works{single};
    for (const int threads : {1, 2})
      works.emplace_back([&, threads] { (void)avi::ensemble(make, starts, h, until, {.threads = threads}); });
    const std::vector<double> seconds = interleaved_least_seconds(works, frame.quick ? 1 : 5);
    Table out =
        frame.table({"problem", "method", "order", "way", "threads", "members", "ok", "steps", "seconds"});
    const long ok = std::count_if(ends.begin(), ends.end(),
                                  [](const auto& member) { return member.run.outcome == avi::Outcome::ok; });
    const long steps = until.steps * members;
    out.note("processors", std::thread::hardware_concurrency());
    for (const int i : {0, 1, 2})
      out.row("shaken_pendulum", "collocation", order, i ? "ensemble" : "single", std::max(i, 1), members, ok,
              steps, seconds[i]);
    frame.write(section, "section");
    frame.write(out);
  });
}
